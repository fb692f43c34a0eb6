#version 330 core
// A shell that shines at its rim.  It is seen where it is apart from the face: brightly in front, dimly behind.

#ifndef DEPTH_ONLY
#include "studio.glsl"

#ifdef MULTISAMPLED
uniform sampler2DMS depth_map;
uniform int samples;
#else
uniform sampler2D depth_map;
const int samples = 1;
#endif

uniform mat4 to_clip;
uniform float close;         // distance from the face at which it begins to be seen
uniform float deep;          // distance behind the face at which it is not seen any more
uniform float pixel_angle;   // height of a pixel at depth 1

in vec3 view_normal;
in vec3 at;
in float tone;

out vec4 pixel;

const vec3 COLOUR = vec3(0.22, 0.58, 1.00);   // seen on skin and on the wall
const float VEIL = 0.42, SHINE = 0.52, BEHIND = 0.5;

// Depth along the view axis of what the depth map (0..1) holds.
float away(float depth)
{
    return to_clip[3][2] / (2.0 * depth - 1.0 + to_clip[2][2]);
}

void main()
{
    float facing = abs(dot(normalize(view_normal), normalize(at)));
    // The sample that is least apart: at outlines, those of the face see past it.
    float apart = 1e30;
    for (int i = 0; i < samples; i++) {
        float gap = away(texelFetch(depth_map, ivec2(gl_FragCoord.xy), i).r) + at.z;
        if (abs(gap) < abs(apart))
            apart = gap;
    }
    // Across the surface rather than along the view; depth is known only to a pixel.
    float across = abs(apart) * max(facing, 0.15) - pixel_angle * -at.z;
    float shown = smoothstep(close, 5.0 * close, across);
    float rim = 1.0 - facing, edge = rim * rim * (1.5 - 0.5 * rim);
    if (apart < 0.0)
        shown *= BEHIND * (1.0 - smoothstep(0.4 * deep, deep, -apart));
    float alpha = shown * (VEIL + SHINE * edge);
    vec3 n = normalize(dot(view_normal, at) < 0.0 ? view_normal : -view_normal);
    float light = (0.55 + 0.45 * dot(n, KEY)) * (0.25 + 1.05 * tone) + 0.35 * edge;
    pixel = vec4(clamp(COLOUR * light + 0.25 * edge, 0.0, 1.0) * alpha, alpha);   // premultiplied, so that pictures without a background add up
}
#else
void main()
{
}
#endif
