// Shadows of things that move, from maps that are drawn for each frame.
uniform sampler2D movers_map;    // m along the key light's way to the first thing that moves
uniform mat4 movers_from_world;  // to place in that map (0..1) and m along the way
uniform float movers_texel;      // m
uniform float light_spread;      // tangent of the key light's half angle

// Fermat's spiral: evenly spread over a disc of radius 1.
vec2 spiral(int i, int count) {
  float angle = 2.39996323 * float(i);
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}

// Share of the key light that arrives. What shades is looked for first; the farther above it is,
// the softer its shadow. Source: Fernando, "Percentage-closer soft shadows", SIGGRAPH 2005.
float arriving(sampler2D map, mat4 map_from_world, float texel, vec3 point, vec3 normal) {
  const float kReach = 0.2;  // m, of the search above the surface
  vec3 place = (map_from_world * vec4(point + 1.5 * texel * normal, 1.0)).xyz;
  if (any(greaterThan(abs(place.xy - 0.5), vec2(0.5)))) return 1.0;
  float uv_per_metre =
      length(vec3(map_from_world[0].x, map_from_world[1].x, map_from_world[2].x));
  float nearest = place.z - 0.5 * texel;
  float gap = 0.0;
  float found = 0.0;
  for (int i = 0; i < 6; ++i) {
    vec2 at = place.xy + (light_spread * kReach + texel) * uv_per_metre * spiral(i, 6);
    float above = nearest - textureLod(map, at, 0.0).r;
    if (above > 0.0) {
      gap += above;
      found += 1.0;
    }
  }
  if (found == 0.0) return 1.0;
  float radius = max(1.5 * texel, light_spread * gap / found) * uv_per_metre;
  float open = 0.0;
  for (int i = 0; i < 12; ++i) {
    vec2 at = place.xy + radius * spiral(i, 12);
    open += step(nearest, textureLod(map, at, 0.0).r);
  }
  return open / 12.0;
}
