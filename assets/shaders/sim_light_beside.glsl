// Light on a still surface beside things that move: what was gathered without them, less the key
// light that they shade and the room's that they cover where they are close above.
uniform sampler2D under_map;    // m upwards to the lowest surface of things that move
uniform mat4 under_from_world;  // to place in that map (0..1) and m upwards

float uncovered(vec3 point) {
  const float kReach = 0.05;  // m
  vec3 place = (under_from_world * vec4(point, 1.0)).xyz;
  if (any(greaterThan(abs(place.xy - 0.5), vec2(0.5)))) return 1.0;
  float uv_per_metre = length(vec3(under_from_world[0].x, under_from_world[1].x, 0.0));
  float covered = 0.0;
  for (int i = 0; i < 10; ++i) {
    vec2 at = place.xy + 0.7 * kReach * uv_per_metre * spiral(i, 10);
    float gap = textureLod(under_map, at, 0.0).r - place.z;
    covered += gap > -0.01 ? max(0.0, 1.0 - max(gap, 0.0) / kReach) : 0.0;
  }
  return 1.0 - 0.08 * covered;
}

vec3 light_here() {
  vec4 gathered = texture(light_map, light_at);
  vec3 light = light_range * gathered.rgb;
  float key = gathered.a;
  if (key > 0.02)
    key *= arriving(movers_map, movers_from_world, movers_texel, point_in_world, normal_in_world);
  float room = 1.0 - gathered.a;
  if (normal_in_world.z > 0.5) room *= uncovered(point_in_world);
  return light * sqrt(key + room);
}
