in vec2 offset;
flat in vec4 axes_;
flat in vec4 color_;
out vec4 color;

void main() {
  // In units of the semi-axes, which are orthogonal, the ellipse is the unit circle.
  vec2 inverse_squares = 1.0 / vec2(dot(axes_.xy, axes_.xy), dot(axes_.zw, axes_.zw));
  vec2 q = vec2(dot(offset, axes_.xy), dot(offset, axes_.zw)) * inverse_squares;
  float radius = max(length(q), 1e-3);
  vec2 gradient = (q.x * axes_.xy * inverse_squares.x + q.y * axes_.zw * inverse_squares.y) / radius;
  float distance = (radius - 1.0) / max(length(gradient), 1e-6);  // px, first order
  float line = clamp(1.3 - abs(distance), 0.0, 1.0);
  float inside = 0.14 * clamp(0.5 - distance, 0.0, 1.0);
  float alpha = color_.a * max(line, inside);
  color = vec4(color_.rgb * alpha, alpha);
}
