layout(location = 0) in vec2 position;  // px, of pixel edges
layout(location = 1) in vec2 texture_place;
layout(location = 2) in vec4 color;
out vec2 place;
out vec4 color_;

void main() {
  place = texture_place;
  color_ = color;
  gl_Position = clip_from_target(position - 0.5, 0.0, 1.0);
}
