// Whether the face is in front of something that is drawn over it.

#ifdef MULTISAMPLED
uniform sampler2DMS depth_map;
#else
uniform sampler2D depth_map;
#endif

const float HIDDEN = 0.3;   // opacity of what is behind the face

// 1 where nothing is nearer than `depth` (0..1) at a pixel, otherwise 0.
float unhidden(vec2 pixel, float depth)
{
    return step(depth, texelFetch(depth_map, ivec2(pixel), 0).r);
}
