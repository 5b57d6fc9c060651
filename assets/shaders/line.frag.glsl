in vec4 color_;
in float across;
uniform float width;  // px
out vec4 color;

void main() {
  float alpha = color_.a * clamp(0.5 * width + 0.5 - abs(across), 0.0, 1.0);
  color = vec4(color_.rgb * alpha, alpha);
}
