// The one way from linear light to the picture.

// The ACES film curve (Narkowicz's fit) and then sRGB, in one: skin keeps its colour, highlights roll off instead
// of clipping.  Fitted to two levels of 8 bits, without pow: this runs at every vertex of every drag frame.
vec3 picture(vec3 light)
{
    vec3 s = sqrt(light);
    return min(light * (1.0878 + 1.0074 * s) / (0.2183 + light * (1.0886 + s)), 1.0);
}

vec3 srgb(vec3 linear)
{
    // Exact enough for 8 bits: three square roots (fit by I. Taylor).
    vec3 s1 = sqrt(linear), s2 = sqrt(s1), s3 = sqrt(s2);
    return 0.662002687 * s1 + 0.684122060 * s2 - 0.323583601 * s3 - 0.0225411470 * linear;
}
