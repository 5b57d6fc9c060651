// Shadows of things that move, from maps that are drawn for each frame.
uniform sampler2D movers_map;    // m along the key light's way to the first thing that moves
uniform mat4 movers_from_world;  // to place in that map (0..1) and m along the way
uniform float movers_texel;      // m
uniform float light_spread;      // tangent of the key light's half angle

uniform vec3 towards_light;

// Whether a mask, which is as wide as its map and coarser, has anything at a place of the map.
int marked(sampler2D mask, vec3 place) {
  bool inside = all(lessThan(abs(place.xy - 0.5), vec2(0.5)));
  ivec2 texel = ivec2(clamp(place.xy, 0.0, 0.999) * vec2(textureSize(mask, 0)));
  return inside && texelFetch(mask, texel, 0).r > 0.5 ? 1 : 0;
}

// Fermat's spiral, evenly spread over a disc: each place is turned by the golden angle from the one
// before, in direction, and as far out as the square root of its number.
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

float spiral_radius(int i, float count) { return sqrt((float(i) + 0.5) / count); }

// Software renderers skip loops that no pixel of a block enters, but not other branches: what is not
// needed everywhere is a loop, with a count that says so.

// Share of the key light that arrives. What shades is looked for first; the farther above it is,
// the softer its shadow. Source: Fernando, "Percentage-closer soft shadows", SIGGRAPH 2005.
const float kSearched = 0.2;  // m above the surface

// `place`: in the map, 1.5 texels off the surface, which does not shade itself then.
float arriving(sampler2D map, mat4 map_from_world, float texel, vec3 place, int wanted) {
  float shaded = 0.0;
  for (int once = 0; once < wanted; ++once) {
    float uv_per_metre =
        length(vec3(map_from_world[0].x, map_from_world[1].x, map_from_world[2].x));
    float nearest = place.z - 0.5 * texel;
    float gap = 0.0;
    float found = 0.0;
    vec2 aside = vec2((light_spread * kSearched + texel) * uv_per_metre, 0.0);
    for (int i = 0; i < 6; ++i) {
      float above = nearest - textureLod(map, place.xy + spiral_radius(i, 6.0) * aside, 0.0).r;
      aside = kGoldenTurn * aside;
      gap += max(above, 0.0);
      found += step(0.0, above);
    }
    aside = vec2(max(1.5 * texel, light_spread * gap / max(found, 1.0)) * uv_per_metre, 0.0);
    int samples = found > 0.0 ? 12 : 0;
    for (int i = 0; i < samples; ++i) {
      float depth_there = textureLod(map, place.xy + spiral_radius(i, 12.0) * aside, 0.0).r;
      aside = kGoldenTurn * aside;
      shaded += step(depth_there, nearest);
    }
  }
  return 1.0 - shaded / 12.0;
}
