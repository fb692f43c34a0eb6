#version 330 core
// See ghost.vert.  The shell is seen where it is apart from the face: brightly in front, dimly behind.

#ifdef DEPTH_ONLY
void main()
{
}
#else
#ifdef SAMPLES
uniform sampler2DMS depth_map;
#else
uniform sampler2D depth_map;
#define SAMPLES 1
#endif

uniform mat4 to_clip;
uniform float close;         // distance from the face at which it begins to be seen
uniform float deep;          // distance behind the face at which it is not seen any more
uniform float pixel_angle;   // height of a pixel at depth 1

centroid in vec4 shell;   // not guessed beyond outlines
centroid in vec2 depth;

out vec4 pixel;

const float BEHIND = 0.6;

// Depth along the view axis of what the depth map (0..1) holds.
float away(float stored)
{
    return to_clip[3][2] / (2.0 * stored - 1.0 + to_clip[2][2]);
}

void main()
{
    // The sample that is least apart: at outlines, those of the face see past it.
    float apart = 1e30;
    for (int i = 0; i < SAMPLES; i++) {
        float gap = away(texelFetch(depth_map, ivec2(gl_FragCoord.xy), i).r) - depth.x;
        apart = abs(gap) < abs(apart) ? gap : apart;
    }
    // Across the surface rather than along the view; depth is known only to a pixel.
    float across = abs(apart) * depth.y - pixel_angle * depth.x;
    float shown = smoothstep(close, 5.0 * close, across);
    if (apart < 0.0)
        shown *= BEHIND * (1.0 - smoothstep(0.4 * deep, deep, -apart));
    float alpha = shell.a * shown;
    pixel = vec4(shell.rgb * alpha, alpha);   // premultiplied, so that pictures without a background add up
}
#endif
