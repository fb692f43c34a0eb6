#version 330 core
// A posed face with its light computed at the vertices: where triangles are a few pixels large it looks like
// mesh.frag, and costs half without a graphics card.  Not for what is glossy.

#include "colour.glsl"
#include "studio.glsl"

uniform mat4 to_view;
uniform mat4 to_clip;
uniform vec3 sky;
uniform vec3 tint;
uniform float roughness;
uniform float facing;   // 1 when front sides are drawn, -1 when back sides are

in vec3 position;
in vec3 normal;
in vec4 albedo;

out vec3 lit;

void main()
{
    vec4 at = to_view * vec4(position, 1.0);
    vec3 n = normalize(mat3(to_view) * normal) * facing;
    lit = picture(studio(n, normalize(-at.xyz), sky, albedo.rgb * tint, roughness, albedo.a));
    gl_Position = to_clip * at;
}
