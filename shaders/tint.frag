#version 330 core
// See tint.vert.

#include "colour.glsl"

in vec4 tint;

out vec4 pixel;

void main()
{
    pixel = vec4(srgb(min(tint.rgb, 1.0)) * tint.a, tint.a);   // premultiplied
}
