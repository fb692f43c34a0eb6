#version 330 core
// See wires.vert.

in vec4 ink;

out vec4 pixel;

void main()
{
    pixel = vec4(ink.rgb * ink.a, ink.a);   // premultiplied, so that pictures without a background add up
}
