#version 330 core
// A posed face.  Positions and normals change with the pose; what comes from the file and from baking does not.

uniform mat4 to_picture;   // from the world to clip space

in vec3 position;
in vec3 normal;    // any length
in vec4 albedo;    // linear base colour; a: how open to the room
in vec3 towards;   // where it opens to

out vec3 world_normal;
out vec4 base;
out vec3 opening;
#ifdef TEXTURED
in vec2 place;
out vec2 place_in_texture;
#endif

void main()
{
    world_normal = normalize(normal);
    base = albedo;
    opening = towards;
#ifdef TEXTURED
    place_in_texture = place;
#endif
    gl_Position = to_picture * vec4(position, 1.0);
}
