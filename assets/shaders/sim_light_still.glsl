// Where nothing moves all light has been gathered beforehand. Square root of light.
vec3 light_here() { return light_range * texture(light_map, light_at).rgb; }
