#version 330 core
// See heat.vert.

#include "colour.glsl"

uniform sampler2D colours;   // linear, of moves from 0 to the top; the last one is for more

in float moved;
in vec2 light;

out vec4 pixel;

void main()
{
    int last = textureSize(colours, 0).x - 1;
    int at = moved > 1.0 ? last : int(max(moved, 0.0) * float(last - 1) + 0.5);
    vec3 colour = texelFetch(colours, ivec2(at, 0), 0).rgb;
    pixel = vec4(srgb(min(colour * (gl_FrontFacing ? light.x : light.y), 1.0)), 1.0);
}
