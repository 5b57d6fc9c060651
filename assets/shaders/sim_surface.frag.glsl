// Joined after one of sim_dull.glsl and sim_shiny.glsl. Colours and the light map hold square
// roots, close to sRGB's curve: their product is the square root of reflected light.
in vec2 texture_at;
in vec2 light_at;
in float depth;
uniform sampler2D pattern;
uniform sampler2D light_map;
uniform float light_range;  // light, as square root, that the map's 1 stands for
uniform float infrared;     // share of a depth camera's light that comes back
layout(location = 0) out vec4 color_out;
layout(location = 1) out float depth_out;

void main() {
  vec3 light = light_range * texture(light_map, light_at).rgb;
  color_out = vec4(with_highlight(texture(pattern, texture_at).rgb * light, light),
                   sent_back(infrared));
  depth_out = depth;
}
