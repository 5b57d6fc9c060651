// Light on a still surface beside things that move: what was gathered without them, less the key
// light that they shade and the room's that they cover where they are close above.
uniform sampler2D under_map;    // m upwards to the lowest surface of things that move
uniform mat4 under_from_world;  // to place in that map (0..1) and m upwards
uniform sampler2D movers_mask;  // where they may shade
uniform sampler2D under_mask;   // where they may cover

const float kReach = 0.05;  // m

float uncovered(vec3 place, int wanted) {
  float covered = 0.0;
  for (int once = 0; once < wanted; ++once) {
    float uv_per_metre = length(vec3(under_from_world[0].x, under_from_world[1].x, 0.0));
    vec2 aside = vec2(0.7 * kReach * uv_per_metre, 0.0);
    for (int i = 0; i < 10; ++i) {
      vec2 at = place.xy + spiral_radius(i, 10.0) * aside;
      aside = kGoldenTurn * aside;
      float gap = textureLod(under_map, at, 0.0).r - place.z;
      covered += gap > -0.01 ? max(0.0, 1.0 - max(gap, 0.0) / kReach) : 0.0;
    }
  }
  return 1.0 - 0.08 * covered;
}

vec3 light_here() {
  vec4 gathered = texture(light_map, light_at);
  vec3 off = point_in_world + 1.5 * movers_texel * normal_in_world;
  vec3 shaded_at = (movers_from_world * vec4(off, 1.0)).xyz;
  int lit = gathered.a > 0.02 ? marked(movers_mask, shaded_at) : 0;
  float key =
      gathered.a * arriving(movers_map, movers_from_world, movers_texel, shaded_at, lit);
  vec3 covered_at = (under_from_world * vec4(point_in_world, 1.0)).xyz;
  int upward = normal_in_world.z > 0.5 ? marked(under_mask, covered_at) : 0;
  float room = (1.0 - gathered.a) * uncovered(covered_at, upward);
  return light_range * gathered.rgb * sqrt(key + room);
}
