#version 330 core
// A dark studio wall: a pool of light behind the face, falling off to the corners.

uniform vec4 pool_of_pixel;   // xy scale, zw offset: the pool's middle is 0, its rim at length 1
uniform vec2 to_whole;        // from a pixel to that of the whole picture, whether it is drawn in tiles or not

out vec4 pixel;

const vec3 MIDDLE = vec3(0.246, 0.256, 0.274), RIM = vec3(0.082, 0.086, 0.098);

void main()
{
    vec2 at = gl_FragCoord.xy * pool_of_pixel.xy + pool_of_pixel.zw;
    float t = min(dot(at, at), 1.0);
    // Half a step of noise hides the bands that a dark gradient has in 8 bits.
    vec2 whole = gl_FragCoord.xy + to_whole;
    float noise = fract(52.9829189 * fract(dot(whole, vec2(0.06711056, 0.00583715)))) - 0.5;
    pixel = vec4(mix(MIDDLE, RIM, t * (2.0 - t)) + noise / 255.0, 1.0);
}
