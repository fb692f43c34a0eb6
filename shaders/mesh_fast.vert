#version 330 core
// A posed face with its light computed at the vertices: where triangles are a few pixels large it looks like
// mesh.frag, and costs half without a graphics card.  Not for what is glossy.

#include "colour.glsl"
#include "studio.glsl"

uniform mat4 to_picture;   // from the world to clip space
uniform vec3 eye;
uniform vec4 paint;        // rgb multiplies the vertex colour, of which there is a
uniform float facing;      // 1 when front sides are drawn, -1 when back sides are

in vec3 position;
in vec3 normal;    // any length
in vec4 albedo;    // linear base colour; a: how open to the room
in vec3 towards;   // where it opens to

noperspective out vec3 lit;   // triangles are small: nobody sees the difference, a processor feels it

void main()
{
    vec3 colour = mix(vec3(1.0), albedo.rgb, paint.a) * paint.rgb;
    lit = picture(studio(facing * normalize(normal), normalize(eye - position), colour, albedo.a, towards));
    gl_Position = to_picture * vec4(position, 1.0);
}
