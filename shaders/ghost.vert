#version 330 core
// Another pose, to be compared with the face.

uniform mat4 to_view;
uniform mat4 to_clip;

in vec3 position;
#ifndef DEPTH_ONLY
in vec3 normal;
in vec4 albedo;   // linear base colour; a: how open to the sky

out vec3 view_normal;
out vec3 at;
out float tone;   // lips, brows and creases are darker, so that they can be told
#endif

invariant gl_Position;   // both passes must find the same depth

void main()
{
    vec4 view = to_view * vec4(position, 1.0);
#ifndef DEPTH_ONLY
    view_normal = mat3(to_view) * normal;
    at = view.xyz;
    tone = sqrt(dot(albedo.rgb, vec3(0.21, 0.72, 0.07)) * albedo.a);
#endif
    gl_Position = to_clip * view;
}
