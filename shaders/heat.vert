#version 330 core
// A posed face that shows how far it moved.  The light is soft, so computing it at vertices is enough; it only
// tells the form and leaves the colours to the scale.

#include "studio.glsl"

uniform mat4 to_picture;   // from the world to clip space
uniform vec3 eye;

in vec3 position;
in vec3 normal;
in vec4 albedo;   // a: how open to the sky
in float heat;    // share of the top of the scale

out float moved;
out vec2 light;   // on the front and on the back

float lit(vec3 n, vec3 to_eye)
{
    float key = 0.5 + 0.5 * dot(n, lamps[0]);
    return 0.36 + 0.44 * key * key + 0.32 * max(dot(n, to_eye), 0.0);
}

void main()
{
    vec3 n = normalize(normal), to_eye = normalize(eye - position);
    light = (0.55 + 0.45 * albedo.a) * vec2(lit(n, to_eye), lit(-n, to_eye));
    moved = heat;
    gl_Position = to_picture * vec4(position, 1.0);
}
