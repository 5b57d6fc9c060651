// Light on a thing that moves. Gathered beforehand is only how open its own shape leaves each place.
uniform sampler2D still_map;    // m along the key light's way to the first still thing
uniform mat4 still_from_world;  // to place in that map (0..1) and m along the way
uniform float still_texel;      // m
uniform vec3 key_light;   // irradiance on a surface that faces it
uniform vec3 room_above;  // radiance
uniform vec3 room_below;

vec3 light_here() {
  vec3 n = normalize(normal_in_world);
  float open = light_range * texture(light_map, light_at).r;
  // The integral of a radiance that grows linearly with height, times the cosine.
  vec3 light = open * open * mix(room_below, room_above, 0.5 + n.z / 3.0);
  float facing = dot(n, towards_light);
  int lit = facing > 0.0 ? 1 : 0;
  vec3 among = (movers_from_world * vec4(point_in_world + 1.5 * movers_texel * n, 1.0)).xyz;
  vec3 below = (still_from_world * vec4(point_in_world + 1.5 * still_texel * n, 1.0)).xyz;
  float seen = arriving(movers_map, movers_from_world, movers_texel, among, lit) *
               arriving(still_map, still_from_world, still_texel, below, lit);
  light += max(facing, 0.0) * seen * key_light;
  return sqrt(light);
}
