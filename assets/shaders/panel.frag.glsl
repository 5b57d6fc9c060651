in vec2 place;
in vec4 color_;
uniform sampler2D picture;
out vec4 color;

void main() { color = color_ * texture(picture, place); }
