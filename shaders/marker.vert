#version 330 core
// Pins: per instance three quads, in this order: the line from vertex to goal, the goal's ring, the vertex's disc.
// Sizes are pixels, whatever the distance.

#include "behind.glsl"

uniform mat4 to_view;
uniform mat4 to_clip;
uniform vec4 rectangle;      // x, y, width, height of the picture in the framebuffer
uniform float pixel_angle;   // height of a pixel at depth 1
uniform float scale;         // pixels per point: 2 on a HiDPI screen

in vec3 position;
in vec3 goal;
in vec4 colour;   // rgb; a: strength of the halo
in float radius;  // of the disc, in points
in float square;  // 1: a square instead of the disc

flat out vec4 ends;        // the two ends in pixels: the same one twice for disc and ring
flat out vec4 style;       // colour of the core, strength of the halo
flat out vec2 shape;       // x: kind, 0 line, 1 ring, 2 disc, 3 square; y: radius in pixels
flat out float strength;   // of disc and ring: less where the face is in front

const vec2 CORNERS[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1), vec2(1, 1));
const vec4 NOWHERE = vec4(2.0, 2.0, 2.0, 1.0);
const float MARGIN = 8.0;   // room for outline and halo, in points

vec2 pixels(vec4 clip)
{
    return rectangle.xy + (clip.xy / clip.w * 0.5 + 0.5) * rectangle.zw;
}

// A marker is dimmed as a whole, softly as it goes behind something.
float seen(vec4 clip)
{
    vec2 at = pixels(clip), low = rectangle.xy + 0.5, high = rectangle.xy + rectangle.zw - 0.5;
    float depth = clip.z / clip.w * 0.5 + 0.5, sum = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++)
            sum += unhidden(clamp(at + scale * vec2(x, y), low, high), depth);
    return sum / 9.0;
}

void main()
{
    int kind = gl_VertexID / 6;
    vec2 corner = CORNERS[gl_VertexID % 6];
    vec3 start = (to_view * vec4(position, 1.0)).xyz, end = (to_view * vec4(goal, 1.0)).xyz;

    // A goal behind the eye is drawn where its line leaves the space in front of it.
    float near = -to_clip[3][2] / (1.0 - to_clip[2][2]);
    if (start.z > -near) {
        gl_Position = NOWHERE;
        return;
    }
    if (end.z > -near)
        end = mix(start, end, (-near - start.z) / (end.z - start.z));

    // Lifted off the skin by a disc's radius, towards the eye along the view ray: the same pixel, a little nearer.
    float lift = 1.0 - min(radius * scale * pixel_angle, 0.5);
    vec4 a = to_clip * vec4(start * lift, 1.0), b = to_clip * vec4(end * lift, 1.0);
    vec2 pa = pixels(a), pb = pixels(b), along = pb - pa;
    float distance = length(along);
    along = distance > 0.01 ? along / distance : vec2(1.0, 0.0);

    bool at_goal = kind == 1 || (kind == 0 && corner.x > 0.0);
    ends = kind == 0 ? vec4(pa, pb) : at_goal ? vec4(pb, pb) : vec4(pa, pa);
    style = colour;
    shape = vec2(kind == 2 ? 2.0 + square : kind, scale * (kind == 0 ? 0.75 : kind == 1 ? 0.72 * radius : radius));
    strength = mix(HIDDEN, 1.0, seen(at_goal ? b : a));

    vec2 offset = (corner.x * along + corner.y * vec2(-along.y, along.x)) * (shape.y + MARGIN * scale);
    gl_Position = at_goal ? b : a;
    gl_Position.xy += offset * 2.0 / rectangle.zw * gl_Position.w;
    // Nothing to see where the vertex is on its goal: the disc covers the ring.
    if (kind < 2 && distance < 0.5)
        gl_Position = NOWHERE;
}
