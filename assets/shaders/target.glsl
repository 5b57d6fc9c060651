uniform vec2 target_size;  // px

// The only place that knows OpenGL's axes. Pixel (0,0) is the centre of the picture's upper left
// one, and row 0 of a target is its upper edge: y is not negated.
vec4 clip_from_target(vec2 pixel, float depth, float w) {
  return vec4((2.0 * (pixel + 0.5) / target_size - 1.0) * w, depth * w, w);
}
