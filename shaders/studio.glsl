// Three soft lights and a sky.  Directions are in view space: x right, y up, z to the eye.

const vec3 KEY = normalize(vec3(-0.55, 0.62, 0.95)), KEY_LIGHT = vec3(2.35, 2.18, 2.00) * 0.5;
const vec3 FILL = normalize(vec3(0.90, 0.12, 0.62)), FILL_LIGHT = vec3(0.384, 0.459, 0.62) * 0.5;
const vec3 RIM = normalize(vec3(0.85, 0.45, -0.85)), RIM_LIGHT = vec3(1.00, 1.10, 1.25) * 0.5;
const vec3 BACK = normalize(vec3(-0.95, 0.10, -0.55)), BACK_LIGHT = vec3(0.70, 0.595, 0.504) * 0.5;
const vec3 SKY_LIGHT = vec3(0.315, 0.345, 0.412) * 0.5, GROUND_LIGHT = vec3(0.18, 0.1275, 0.1125) * 0.5;

// Diffuse light that reaches round the terminator.  What scatters more reaches further, colour by colour: skin
// turns red there, hair does not.
vec3 wrapped(float nl, vec3 wrap)
{
    vec3 d = max((nl + wrap) / (1.0 + wrap), 0.0);
    return d * mix(vec3(1.0), d, 0.35);
}

// GGX with a cheap visibility term; multiplied by the cosine.
float glint(vec3 n, vec3 to_eye, vec3 to_light, float nl, float a2)
{
    vec3 h = normalize(to_eye + to_light);
    float nh = max(dot(n, h), 0.0), lh = max(dot(to_light, h), 0.1);
    float d = nh * nh * (a2 - 1.0) + 1.0;
    return max(nl, 0.0) * a2 / (d * d * lh * lh * (sqrt(a2) * 4.0 + 2.0));
}

vec3 studio(vec3 n, vec3 to_eye, vec3 sky, vec3 albedo, float roughness, float open)
{
    float key = dot(n, KEY), fill = dot(n, FILL), rim = dot(n, RIM), back = dot(n, BACK);
    vec3 wrap = 0.55 * albedo;
    vec3 diffuse = KEY_LIGHT * wrapped(key, wrap) + FILL_LIGHT * wrapped(fill, wrap)
                 + RIM_LIGHT * wrapped(rim, wrap * 0.4) + BACK_LIGHT * wrapped(back, wrap * 0.4);
    float up = dot(n, sky) * 0.5 + 0.5;
    diffuse += mix(GROUND_LIGHT, SKY_LIGHT, up) * open;

    float a = roughness * roughness, a2 = a * a;
    float edge = 1.0 - max(dot(n, to_eye), 0.0), edge2 = edge * edge;
    float fresnel = 0.04 + 0.96 * edge2 * edge2 * edge;
    vec3 shine = 0.04 * (KEY_LIGHT * glint(n, to_eye, KEY, key, a2) + FILL_LIGHT * glint(n, to_eye, FILL, fill, a2));
    shine += mix(GROUND_LIGHT, SKY_LIGHT, up) * fresnel * (1.0 - roughness) * open;
    return albedo * diffuse + shine;
}
