#version 330 core
// Colour laid over a face that is drawn already, lifted off it as little as lets it be seen.  The light is soft,
// so computing it at vertices is enough; it keeps the form of the skin below.

#include "studio.glsl"

uniform mat4 to_view;
uniform mat4 to_clip;
uniform vec3 eye;
uniform float pixel_angle;   // height of a pixel at depth 1

in vec3 position;
in vec3 normal;
in float share;   // 0..1, of the strongest

out vec4 tint;

const vec3 COLOUR = vec3(0.16, 0.62, 1.00);   // linear; seen on any skin
const float STRONGEST = 0.72;
const float LEAST = 0.015;   // share below which nobody would call it a move

void main()
{
    vec3 n = normalize(normal), to_eye = normalize(eye - position);
    n = dot(n, to_eye) < 0.0 ? -n : n;
    float facing = dot(n, to_eye), key = 0.5 + 0.5 * dot(n, lamps[0]);
    float light = 0.30 + 0.42 * key * key + 0.38 * facing;
    float shown = STRONGEST * smoothstep(LEAST, 4.0 * LEAST, share) * pow(share, 0.45);
    tint = vec4(COLOUR * light, shown);
    vec3 at = (to_view * vec4(position, 1.0)).xyz;
    float slope = min(sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.01), 3.0);
    float lift = pixel_angle * (0.4 + 0.5 * slope);   // less than that of the edges
    gl_Position = to_clip * vec4(at * (1.0 - min(lift, 0.5)), 1.0);
}
