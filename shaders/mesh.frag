#version 330 core
// The studio: everything in view space, so that the lights travel with the camera and every view is well lit.

#include "colour.glsl"
#include "studio.glsl"

uniform vec4 ray_of_pixel;   // xy scale and zw offset from a pixel to the view ray through it, at depth 1
uniform vec3 sky;            // the world's up
uniform vec3 tint;
uniform float roughness;

in vec3 view_normal;
in vec4 base;

out vec4 pixel;

void main()
{
    vec3 to_eye = normalize(vec3(-(gl_FragCoord.xy * ray_of_pixel.xy + ray_of_pixel.zw), 1.0));
    vec3 n = normalize(gl_FrontFacing ? view_normal : -view_normal);
    pixel = vec4(picture(studio(n, to_eye, sky, base.rgb * tint, roughness, base.a)), 1.0);
}
