"""Pictures of faces with moderngl (OpenGL 3.3 core, no extensions).

The context is always passed in; nothing here keeps one in a global.  Every drawing function sets all the
state it relies on (framebuffer, viewport, scissor, tests, blending, culling), so it may follow drawing by
others, such as imgui's.
"""
