#version 330 core
// Edges, lifted off the face a little so that it does not hide its own.

uniform mat4 to_view;
uniform mat4 to_clip;
uniform float pixel_angle;   // height of a pixel at depth 1
uniform float scale;         // pixels per point
uniform bool plain;          // the face is drawn in other colours than its own

in vec3 position;
in vec3 normal;
in vec4 albedo;     // linear base colour
in float spacing;   // mean length of the edges here

out vec4 ink;

const vec3 DARK = vec3(0.03, 0.035, 0.05), LIGHT = vec3(0.66, 0.64, 0.62);

const float STRENGTH = 0.42;
const float ROOMY = 9.0;     // points between lines from which on they have their full strength
const float FAINTEST = 0.3;

void main()
{
    vec3 at = (to_view * vec4(position, 1.0)).xyz;
    // What is seen at an angle changes its depth faster from pixel to pixel.
    float facing = abs(dot(normalize(mat3(to_view) * normal), normalize(at)));
    float slope = min(sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.01), 3.0);
    float lift = pixel_angle * (0.8 + slope);
    gl_Position = to_clip * vec4(at * (1.0 - min(lift, 0.5)), 1.0);
    float points = spacing / (-at.z * pixel_angle * scale);
    float strength = min(scale * STRENGTH * clamp(points / ROOMY, FAINTEST, 1.0), 1.0);
    bool on_dark = !plain && dot(albedo.rgb, vec3(0.21, 0.72, 0.07)) < 0.05;
    ink = on_dark ? vec4(LIGHT, 0.5 * strength) : vec4(DARK, strength);
}
