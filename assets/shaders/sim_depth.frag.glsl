// Depth alone, as a light sees it.
in float depth;
out float depth_out;

void main() { depth_out = depth; }
