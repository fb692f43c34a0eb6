// Four soft lamps and a room.  Directions are those of the world; the lamps travel with the camera (see
// gpu/lamps.py), so that every view is well lit.

uniform mat4x3 lamps;     // unit vectors to the key, the fill, the rim and the back light
uniform vec3 scatter;     // how far light spreads under the surface before it comes out, colour by colour
uniform vec3 gather;      // 1 / (1 + scatter)
uniform float roughness;
uniform float reflects;   // share of the light that is reflected straight ahead

const vec3 KEY_LIGHT = vec3(1.50, 1.39, 1.27), FILL_LIGHT = vec3(0.17, 0.21, 0.28);
const vec3 RIM_LIGHT = vec3(0.62, 0.71, 0.87), BACK_LIGHT = vec3(0.42, 0.36, 0.31);
const vec3 SKY_LIGHT = vec3(0.19, 0.21, 0.25), GROUND_LIGHT = vec3(0.105, 0.090, 0.080);

// How much of each lamp a point sees.  `open`: share of the room; `towards`: where it opens to.
vec4 lamps_seen(float open, vec3 towards)
{
    return clamp(open + towards * lamps, 0.0, 1.0);
}

vec3 room_light(float up)
{
    return mix(GROUND_LIGHT, SKY_LIGHT, 0.5 * up + 0.5);
}

// Diffuse light that reaches round the terminator; skin turns red there, hair does not.
vec3 wrapped(float nl)
{
    vec3 d = max((nl + scatter) * gather, 0.0);
    return d * (0.5 + 0.5 * d);
}

// Light that a point sends to the eye.
vec3 studio(vec3 n, vec3 to_eye, vec3 albedo, float open, vec3 towards)
{
    // Nothing is whiter than snow, nor blacker than black as samples beyond the edge of a triangle guess.
    albedo = clamp(albedo, 0.0, 0.8);
    open = clamp(open, 0.0, 1.0);
    vec4 nl = n * lamps, seen = lamps_seen(open, towards);

    // Shadows of soft lamps are soft, and under skin light spreads into them.
    seen *= seen;
    vec3 key_seen = seen.x + scatter * (seen.x - seen.x * seen.x);
    vec2 behind = max(0.87 * nl.zw + 0.13, 0.0) * seen.zw;
    vec3 diffuse = key_seen * KEY_LIGHT * wrapped(nl.x) + seen.y * FILL_LIGHT * wrapped(nl.y)
                 + behind.x * behind.x * RIM_LIGHT + behind.y * behind.y * BACK_LIGHT;
    // What bounces about in a cavity takes on its colour: skin is red, not black, in its folds.
    open *= 0.35 + 0.65 * open;   // most of the room's light comes from in front, not from all around
    vec3 around = room_light(n.y);
    diffuse += around * (open / (1.0 - albedo * (1.0 - open)));

    // GGX (Walter 2007) with Karis' visibility term, of both lamps in front, without the half vectors.
    float a = max(roughness * roughness, 0.002), nv = max(dot(n, to_eye), 0.0);
    vec2 near = max(1.0 + (to_eye * lamps).xy, 0.02), h = nv + nl.xy, d = (a * a - 1.0) * h * h + 2.0 * near;
    vec2 glint = max(nl.xy, 0.0) * seen.xy * (8.0 * a * a / (4.0 * a + 2.0)) * near / (d * d);
    vec3 shine = reflects * (KEY_LIGHT * glint.x + FILL_LIGHT * glint.y);
    float edge = 1.0 - nv, edge2 = edge * edge;
    float fresnel = reflects + (1.0 - reflects) * edge2 * edge2 * edge;
    shine += around * (fresnel * (1.0 - roughness) * (1.0 - roughness) * open);
    return albedo * diffuse + shine;
}
