// Three soft lights and a room.  Directions are in view space: x right, y up, z to the eye, so that the lights
// travel with the camera and every view is well lit.

const vec3 KEY = normalize(vec3(-0.60, 0.70, 0.80)), KEY_LIGHT = vec3(1.20, 1.12, 1.02);
const vec3 FILL = normalize(vec3(0.90, 0.10, 0.62)), FILL_LIGHT = vec3(0.17, 0.21, 0.28);
const vec3 RIM = normalize(vec3(0.80, 0.45, -0.75)), RIM_LIGHT = vec3(0.62, 0.71, 0.87);
const vec3 BACK = normalize(vec3(-0.95, 0.15, -0.55)), BACK_LIGHT = vec3(0.42, 0.36, 0.31);
const vec3 SKY_LIGHT = vec3(0.30, 0.32, 0.37), GROUND_LIGHT = vec3(0.150, 0.125, 0.110);

// Diffuse light that reaches round the terminator.  What scatters more reaches further, colour by colour: skin
// turns red there, hair does not.
vec3 wrapped(float nl, vec3 wrap)
{
    vec3 d = max((nl + wrap) / (1.0 + wrap), 0.0);
    return d * mix(vec3(1.0), d, 0.5);
}

// GGX (Walter 2007) with the visibility term of Karis; multiplied by the cosine.
float glint(vec3 n, vec3 to_eye, vec3 to_light, float nl, float a2)
{
    vec3 h = normalize(to_eye + to_light);
    float nh = max(dot(n, h), 0.0), lh = max(dot(to_light, h), 0.1);
    float d = nh * nh * (a2 - 1.0) + 1.0;
    return max(nl, 0.0) * a2 / (d * d * lh * lh * (sqrt(a2) * 4.0 + 2.0));
}

// Light that a point sends to the eye.  `open`: share of the room that the point sees.
vec3 studio(vec3 n, vec3 to_eye, vec3 sky, vec3 albedo, float roughness, float open)
{
    albedo = min(albedo, 0.8);   // nothing is whiter than snow
    open *= 0.35 + 0.65 * open;   // most light comes from in front, not from all around
    // What bounces about in a cavity takes on its colour: skin is red, not black, in its folds.
    vec3 room = open / (1.0 - albedo * (1.0 - open));
    vec3 lamps = mix(room, vec3(1.0), 0.35 * open);
    float key = dot(n, KEY), fill = dot(n, FILL);
    vec3 wrap = 0.45 * albedo, thin = 0.2 * albedo;
    vec3 diffuse = lamps * (KEY_LIGHT * wrapped(key, wrap) + FILL_LIGHT * wrapped(fill, wrap)
                 + RIM_LIGHT * wrapped(dot(n, RIM), thin) + BACK_LIGHT * wrapped(dot(n, BACK), thin));
    vec3 around = mix(GROUND_LIGHT, SKY_LIGHT, dot(n, sky) * 0.5 + 0.5);
    diffuse += room * around;

    float a = roughness * roughness, a2 = a * a;
    float edge = 1.0 - max(dot(n, to_eye), 0.0), edge2 = edge * edge;
    float fresnel = 0.04 + 0.96 * edge2 * edge2 * edge;
    vec3 shine = 0.04 * (KEY_LIGHT * glint(n, to_eye, KEY, key, a2) + FILL_LIGHT * glint(n, to_eye, FILL, fill, a2));
    shine += around * fresnel * (1.0 - 0.6 * roughness);
    if (roughness < 0.15) {
        // Wet: the lamps themselves are seen, a large one and its small companion.
        vec3 mirrored = reflect(-to_eye, n);
        shine += KEY_LIGHT * smoothstep(0.968, 0.978, dot(mirrored, KEY))
               + FILL_LIGHT * 1.5 * smoothstep(0.990, 0.994, dot(mirrored, FILL));
    }
    return albedo * diffuse + shine * open;
}
