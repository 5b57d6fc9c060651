// What a surface's vertices tell its pixels; first of a simulated surface's parts.
in vec3 point_in_world;
in vec3 normal_in_world;
in vec2 texture_at;
in vec2 light_at;
in float depth;
uniform sampler2D light_map;
uniform float light_range;  // light, as square root, that the map's 1 stands for
