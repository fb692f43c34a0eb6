#version 330 core
// Where the surface faces, as colours.

uniform mat4 to_picture;   // from the world to clip space
uniform mat3 camera;       // its right, up and back in the world

in vec3 position;
in vec3 normal;   // any length

out vec3 view_normal;

void main()
{
    view_normal = normalize(normal) * camera;
    gl_Position = to_picture * vec4(position, 1.0);
}
