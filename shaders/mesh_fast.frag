#version 330 core
// See mesh_fast.vert.

noperspective in vec3 lit;

out vec4 pixel;

void main()
{
    pixel = vec4(lit, 1.0);
}
