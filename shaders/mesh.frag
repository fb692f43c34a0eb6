#version 330 core
// The studio, pixel by pixel.

#include "colour.glsl"
#include "studio.glsl"

uniform mat3 camera;         // its right, up and back in the world
uniform vec4 ray_of_pixel;   // xy scale and zw offset from a pixel to the view ray through it, at depth 1
uniform vec4 paint;          // rgb multiplies the vertex colour, of which there is a

in vec3 world_normal;
in vec4 base;
in vec3 opening;
#ifdef TEXTURED
uniform sampler2D colours;
uniform float cutout;   // alpha below which there is nothing
in vec2 place_in_texture;
#endif
#if defined(TEXTURED) || defined(BLENDED)
uniform float opacity;  // multiplies the alpha of the texture
#endif
#if defined(TEXTURED) && defined(BLENDED)
uniform float solid;    // alpha from which on it has been drawn already
#endif

out vec4 pixel;

#ifdef WET
// How open to the room an eye is.  It turns under its lids while their shadow stays where they are, so it is told
// by where the surface faces.
float opening_of_eye(vec3 n)
{
    float upper = smoothstep(-0.1, 0.65, n.y), lower = smoothstep(0.4, 0.95, -n.y), side = smoothstep(0.45, 0.95, abs(n.x));
    return (1.0 - 0.58 * upper) * (1.0 - 0.20 * lower) * (1.0 - 0.25 * side);
}

// A window pane seen in something wet: x and y across it, 1 at its edges.
float pane(vec2 at, float soft)
{
    vec2 out_of = max(abs(at) - 0.6, 0.0);
    return 1.0 - smoothstep(0.4 - soft, 0.4 + soft, length(out_of));
}

// The lamps themselves in a wet eye: a large soft box and its small companion.
vec3 mirrored_lamps(vec3 n, vec3 to_eye, vec4 seen)
{
    vec3 ray = reflect(-to_eye, n) * camera, key = lamps[0] * camera, fill = lamps[1] * camera;
    // Where the ray meets the plane of the box, in half widths of it.
    vec2 box = (ray.xy - key.xy * dot(ray, key)) / vec2(0.155, 0.19), small = (ray.xy - fill.xy * dot(ray, fill)) / 0.09;
    float front = step(0.0, dot(ray, key)), soft = clamp(length(fwidth(box)), 0.12, 0.4);
    return KEY_LIGHT * (2.0 * pane(box, soft) * front * smoothstep(0.0, 0.4, seen.x))
         + FILL_LIGHT * (1.6 * pane(small, 0.3) * step(0.0, dot(ray, fill)) * seen.y);
}

#endif

float alpha = 1.0;

// The colour of the surface here; grey where only its lightness counts.
vec3 painted()
{
    vec3 own = base.rgb;
#ifdef BLENDED
    alpha = opacity;
#endif
#ifdef TEXTURED
    vec4 texel = texture(colours, place_in_texture);
    float there = texel.a * opacity;
    if (there < cutout)
        discard;
#ifdef BLENDED
    if (there >= solid)
        discard;
    alpha = there;
#endif
    own *= texel.rgb;
#endif
    own = paint.a < 0.0 ? vec3(dot(own, vec3(0.21, 0.72, 0.07))) : own;
    return mix(vec3(1.0), own, abs(paint.a)) * paint.rgb;
}

void main()
{
    vec3 to_eye = normalize(camera * vec3(-(gl_FragCoord.xy * ray_of_pixel.xy + ray_of_pixel.zw), 1.0));
    vec3 n = normalize(gl_FrontFacing ? world_normal : -world_normal);
#ifdef WET
    float open = opening_of_eye(n);
    vec3 mirrored = mirrored_lamps(n, to_eye, lamps_seen(open, vec3(0.0)));   // before anything is discarded
    vec3 light = studio(n, to_eye, painted(), open, vec3(0.0)) + mirrored;
#else
    vec3 light = studio(n, to_eye, painted(), base.a, opening);
#endif
    pixel = vec4(picture(light), alpha);
}
