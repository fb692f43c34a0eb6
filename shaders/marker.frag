#version 330 core
// Discs, rings and lines from their distance in pixels: smooth edges without multisampling.

#include "behind.glsl"

uniform float scale;

flat in vec4 ends;
flat in vec4 style;
flat in vec2 shape;
flat in float strength;

out vec4 pixel;

const vec3 OUTLINE = vec3(0.05, 0.055, 0.07);

float to_segment(vec2 p, vec2 a, vec2 b)
{
    vec2 pa = p - a, ba = b - a;
    return length(pa - ba * clamp(dot(pa, ba) / max(dot(ba, ba), 1e-6), 0.0, 1.0));
}

// As far as from the middle of a disc that just fits round a square with soft corners.
float to_square(vec2 p, float radius)
{
    vec2 out_of = abs(p) - 0.70 * radius;
    return length(max(out_of, 0.0)) + min(max(out_of.x, out_of.y), 0.0) + 0.82 * radius;
}

// How much of the pixel lies within `edge` of the centre line.
float covered(float away, float edge)
{
    return clamp(edge - away + 0.5, 0.0, 1.0);
}

vec4 over(vec4 front, vec4 back)
{
    float alpha = front.a + back.a * (1.0 - front.a);
    return vec4((front.rgb * front.a + back.rgb * back.a * (1.0 - front.a)) / max(alpha, 1e-6), alpha);
}

void main()
{
    float away = to_segment(gl_FragCoord.xy, ends.xy, ends.zw);
    float border = 1.5 * scale, half_width = shape.y;
    if (shape.x == 1.0) {
        half_width = 0.9 * scale;
        away = abs(away - shape.y);
    } else if (shape.x == 3.0) {
        away = to_square(gl_FragCoord.xy - ends.xy, shape.y);
    }
    // A soft shadow under a dark outline under the core: seen on light and on dark skin.
    float shadow = clamp(1.0 - (away - half_width - border) / (2.5 * scale), 0.0, 1.0);
    vec4 c = vec4(OUTLINE, 0.25 * shadow * shadow);
    if (shape.x >= 2.0) {
        float glow = clamp(1.0 - (away - half_width) / (6.5 * scale), 0.0, 1.0);
        c = over(vec4(style.rgb, style.a * glow * glow), c);
    }
    c = over(vec4(OUTLINE, 0.9 * covered(away, half_width + border)), c);
    c = over(vec4(style.rgb, covered(away, half_width)), c);
    if (shape.x >= 2.0)
        c = over(vec4(OUTLINE, 0.9 * covered(away, 0.3 * half_width)), c);
    // A line dips in and out of the face along its way.
    c.a *= shape.x == 0.0 ? mix(HIDDEN, 1.0, unhidden(gl_FragCoord.xy, gl_FragCoord.z)) : strength;
    pixel = vec4(c.rgb * c.a, c.a);   // premultiplied, so that pictures without a background add up
}
