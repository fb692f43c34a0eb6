#version 330 core
// Another pose, to be compared with the face: a shell that shines at its rim.  Its light is soft, so computing it
// at vertices is enough.

uniform mat4 to_view;
uniform mat4 to_clip;

in vec3 position;
#ifndef DEPTH_ONLY
in vec3 normal;
uniform vec3 key;   // direction to the key light, as the camera sees it

in vec4 albedo;   // linear base colour; a: how open to the sky

centroid out vec4 shell;
centroid out vec2 depth;   // along the view axis; how much of it is across the surface

const vec3 COLOUR = vec3(0.32, 0.74, 1.00);   // seen on skin and on the wall
const float VEIL = 0.36, SHINE = 0.54;
#endif

invariant gl_Position;   // both passes must find the same depth

void main()
{
    vec4 at = to_view * vec4(position, 1.0);
#ifndef DEPTH_ONLY
    vec3 to_eye = -normalize(at.xyz), n = normalize(mat3(to_view) * normal);
    float facing = dot(n, to_eye);
    n = facing < 0.0 ? -n : n;
    float rim = 1.0 - abs(facing), edge = rim * rim * (1.5 - 0.5 * rim);
    // Lips, brows and creases are darker, so that they can be told.
    float tone = sqrt(dot(albedo.rgb, vec3(0.21, 0.72, 0.07)) * albedo.a);
    float light = min((0.75 + 0.30 * dot(n, key)) * (0.30 + 0.90 * tone), 1.0);
    shell = vec4(mix(COLOUR * light, vec3(1.0), 0.3 * edge), VEIL + SHINE * edge);
    depth = vec2(-at.z, max(abs(facing), 0.05));
#endif
    gl_Position = to_clip * at;
}
