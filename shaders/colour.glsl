// The one way from linear light to the picture: a soft shoulder, then sRGB.

vec3 srgb(vec3 linear)
{
    // Exact enough for 8 bits and without pow: three square roots (fit by I. Taylor).
    vec3 s1 = sqrt(linear), s2 = sqrt(s1), s3 = sqrt(s2);
    return 0.662002687 * s1 + 0.684122060 * s2 - 0.323583601 * s3 - 0.0225411470 * linear;
}

vec3 picture(vec3 light)
{
    // Narkowicz's fit of the ACES curve: skin keeps its colour, highlights roll off instead of clipping.
    vec3 c = light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14);
    return srgb(clamp(c, 0.0, 1.0));
}
