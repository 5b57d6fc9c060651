// The tracker's weights over the video: what it trusts stays clear, what it rejects is tinted.
in vec2 place;
uniform sampler2D picture;
uniform vec3 tint;
out vec4 color;

void main() {
  float weight = texture(picture, place).r;
  float rejected = isnan(weight) ? 0.0 : 0.6 * (1.0 - clamp(weight, 0.0, 1.0));
  color = vec4(tint * rejected, rejected);
}
