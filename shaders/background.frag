#version 330 core
// A dark studio wall: a pool of light behind the face, falling off to the corners.

uniform vec4 ray_of_pixel;
uniform vec2 half_picture;   // half width and height of the whole picture, at depth 1

out vec4 pixel;

const vec3 NEAR = vec3(0.250, 0.262, 0.285), FAR = vec3(0.082, 0.087, 0.102);

void main()
{
    vec2 at = (gl_FragCoord.xy * ray_of_pixel.xy + ray_of_pixel.zw) / half_picture;
    float away = length(at * vec2(0.85, 0.75) - vec2(0.0, 0.1));
    float t = min(away / 1.25, 1.0);
    // Half a step of noise hides the bands that a dark gradient has in 8 bits.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    pixel = vec4(mix(NEAR, FAR, t * t * (3.0 - 2.0 * t)) + noise / 255.0, 1.0);
}
