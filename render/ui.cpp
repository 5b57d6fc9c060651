#include "render/ui.hpp"

#include <array>
#include <filesystem>
#include <utility>

#include <imgui/imgui_freetype.h>

namespace armsreach::render {
namespace {

constexpr const char* kInter = "/usr/share/fonts/opentype/inter/";
constexpr const char* kMono = "/usr/share/fonts/truetype/jetbrains-mono/";

void apply_theme() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = theme::kRounding;
  style.ChildRounding = theme::kRounding;
  style.PopupRounding = theme::kRounding;
  style.FrameRounding = theme::kSmallRounding;
  style.GrabRounding = theme::kSmallRounding;
  style.ScrollbarRounding = theme::kSmallRounding;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = 0;
  style.WindowPadding = {14, 12};
  style.FramePadding = {11, 6};
  style.ItemSpacing = {8, 7};
  style.CellPadding = {6, 3};
  style.ScrollbarSize = 10;
  const auto set = [&style](int index, const theme::Color& color) {
    style.Colors[index] = imgui_color4(color);
  };
  theme::Color accent_dim = theme::kAccent;
  accent_dim[3] = 70;
  theme::Color accent_mid = theme::kAccent;
  accent_mid[3] = 120;
  constexpr theme::Color kNone{0, 0, 0, 0};
  set(ImGuiCol_Text, theme::kInk);
  set(ImGuiCol_TextDisabled, theme::kQuiet);
  set(ImGuiCol_WindowBg, theme::kPanel);
  set(ImGuiCol_ChildBg, kNone);
  set(ImGuiCol_PopupBg, theme::kRaised);
  set(ImGuiCol_Border, theme::kLine);
  set(ImGuiCol_FrameBg, theme::kRaised);
  set(ImGuiCol_FrameBgHovered, theme::kLine);
  set(ImGuiCol_FrameBgActive, theme::kLine);
  set(ImGuiCol_Button, theme::kRaised);
  set(ImGuiCol_ButtonHovered, theme::kLine);
  set(ImGuiCol_ButtonActive, accent_dim);
  set(ImGuiCol_Header, accent_dim);
  set(ImGuiCol_HeaderHovered, theme::kLine);
  set(ImGuiCol_HeaderActive, accent_mid);
  set(ImGuiCol_CheckMark, theme::kAccent);
  set(ImGuiCol_SliderGrab, theme::kAccent);
  set(ImGuiCol_Separator, theme::kLine);
  set(ImGuiCol_TableHeaderBg, kNone);
  set(ImGuiCol_TableBorderLight, theme::kLine);
  set(ImGuiCol_TableBorderStrong, theme::kLine);
  set(ImGuiCol_TableRowBg, kNone);
  set(ImGuiCol_TableRowBgAlt, kNone);
  set(ImGuiCol_ScrollbarBg, kNone);
  set(ImGuiCol_ScrollbarGrab, theme::kLine);
}

}  // namespace

Result<Ui> Ui::make(const Gl& gl) {
  Ui ui;
  auto painter = PanelPainter::make(gl);
  if (!painter) return painter.error();
  ui.painter_ = *std::move(painter);
  ui.context_.reset(ImGui::CreateContext());
  ImGui::SetCurrentContext(ui.context_.get());
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // the program's files are the user's choice
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  apply_theme();
  ui.load_fonts(gl);
  return ui;
}

void Ui::load_fonts(const Gl& gl) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
  static constexpr std::array<ImWchar, 9> kRanges{0x20,   0x17F,  0x2010, 0x2026, 0x2190,
                                                  0x2193, 0x2212, 0x2212, 0};
  const auto load = [&](const std::string& file, float size, const char* package) -> ImFont* {
    if (std::filesystem::exists(file)) {
      if (ImFont* font = atlas.AddFontFromFileTTF(file.c_str(), size, nullptr, kRanges.data()))
        return font;
    }
    notes_.push_back("font " + file + " is missing, using a plain one (install " + package + ")");
    ImFontConfig config;
    config.SizePixels = size;
    return atlas.AddFontDefault(&config);
  };
  fonts_.text = load(std::string(kInter) + "Inter-Regular.otf", theme::kTextSize, "fonts-inter");
  fonts_.strong = load(std::string(kInter) + "Inter-SemiBold.otf", theme::kTextSize, "fonts-inter");
  fonts_.small = load(std::string(kInter) + "Inter-Medium.otf", 13, "fonts-inter");
  fonts_.figures =
      load(std::string(kMono) + "JetBrainsMono-Regular.ttf", 14, "fonts-jetbrains-mono");
  unsigned char* pixels = nullptr;
  int width = 0;
  int height = 0;
  atlas.GetTexDataAsRGBA32(&pixels, &width, &height);
  atlas_ = Texture(gl, width, height, {});
  atlas_.upload(pixels);
  atlas.SetTexID(imgui_texture(atlas_));
  atlas.ClearTexData();
}

void Ui::begin(const InputState& input, int width, int height) {
  ImGui::SetCurrentContext(context_.get());
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = 1.F / 30;  // the same picture whatever the machine's speed
  io.MousePos = {input.mouse.x(), input.mouse.y()};
  for (std::size_t i = 0; i < input.down.size(); ++i) io.MouseDown[i] = input.down[i];
  io.MouseWheel = input.wheel;
  io.AddInputCharactersUTF8(input.text.c_str());
  ImGui::NewFrame();
}

void Ui::end_and_draw() {
  ImGui::Render();
  painter_.draw(*ImGui::GetDrawData());
}

}  // namespace armsreach::render
