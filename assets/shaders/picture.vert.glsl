// A texture over a rectangle of the target.
uniform vec4 rectangle;  // px: corner and extent, of pixel edges
uniform vec4 part;       // of the texture, 0..1: corner and extent
out vec2 place;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  place = part.xy + part.zw * corner;
  gl_Position = clip_from_target(rectangle.xy + rectangle.zw * corner - 0.5, 0.0, 1.0);
}
