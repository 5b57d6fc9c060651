// Joined after sim_inputs.glsl, one of the sim_light_*.glsl and one of sim_dull.glsl and
// sim_shiny.glsl. Colours and light are square roots, close to sRGB's curve: their product is the
// square root of reflected light.
uniform sampler2D pattern;
uniform float infrared;  // share of a depth camera's light that comes back
uniform float instance;  // of the thing in the masks
layout(location = 0) out vec4 color_out;
layout(location = 1) out vec2 depth_and_instance_out;

void main() {
  vec3 light = light_here();
  color_out = vec4(with_highlight(texture(pattern, texture_at).rgb * light, light),
                   sent_back(infrared));
  depth_and_instance_out = vec2(depth, instance);
}
