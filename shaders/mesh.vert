#version 330 core
// A posed face.  Positions and normals change with the pose; albedo does not.

uniform mat4 to_view;
uniform mat4 to_clip;

in vec3 position;
in vec3 normal;   // any length
in vec4 albedo;   // linear base colour; a: how open to the sky

out vec3 view_normal;
out vec4 base;

void main()
{
    view_normal = normalize(mat3(to_view) * normal);
    base = albedo;
    gl_Position = to_clip * (to_view * vec4(position, 1.0));
}
