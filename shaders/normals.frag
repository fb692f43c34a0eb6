#version 330 core
// See normals.vert.  The colours of a normal map seen from the camera: red to the right, green up, blue to the eye.

in vec3 view_normal;

out vec4 pixel;

void main()
{
    vec3 n = normalize(gl_FrontFacing ? view_normal : -view_normal);
    pixel = vec4(0.5 * n + 0.5, 1.0);
}
