// Light on a thing that moves. Gathered beforehand is only how open its own shape leaves each place.
uniform sampler2D still_map;    // m along the key light's way to the first still thing
uniform mat4 still_from_world;  // to place in that map (0..1) and m along the way
uniform float still_texel;      // m
uniform vec3 towards_light;
uniform vec3 key_light;   // irradiance on a surface that faces it
uniform vec3 room_above;  // radiance
uniform vec3 room_below;

vec3 light_here() {
  vec3 n = normalize(normal_in_world);
  float open = light_range * texture(light_map, light_at).r;
  // The integral of a radiance that grows linearly with height, times the cosine.
  vec3 light = open * open * mix(room_below, room_above, 0.5 + n.z / 3.0);
  float facing = dot(n, towards_light);
  if (facing > 0.0) {
    float seen = arriving(movers_map, movers_from_world, movers_texel, point_in_world, n);
    if (seen > 0.0) seen *= arriving(still_map, still_from_world, still_texel, point_in_world, n);
    light += facing * seen * key_light;
  }
  return sqrt(light);
}
