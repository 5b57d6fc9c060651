#include "render/panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "render/annotations.hpp"
#include "render/mesh.hpp"

namespace armsreach::render {
namespace {

// "12.30" for (12.3, 2).
std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

ImVec2 corner_of(const Rectangle& r) { return {static_cast<float>(r.x), static_cast<float>(r.y)}; }
ImVec2 size_of(const Rectangle& r) {
  return {static_cast<float>(r.width), static_cast<float>(r.height)};
}

theme::Color severity_color(Severity severity) {
  switch (severity) {
    case Severity::info:
      return theme::kAccent;
    case Severity::warning:
      return theme::kWarning;
    case Severity::error:
      return theme::kBad;
  }
  return theme::kInk;
}

std::string state_or_idle(const Scene& scene) {
  return scene.tracking_state.empty() ? "idle" : scene.tracking_state;
}

bool begin_panel(const char* name, const Rectangle& place) {
  ImGui::SetNextWindowPos(corner_of(place));
  ImGui::SetNextWindowSize(size_of(place));
  return ImGui::Begin(name, nullptr,
                      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                          ImGuiWindowFlags_NoBringToFrontOnFocus);
}

void heading(const Fonts& fonts, const char* text) {
  ImGui::PushFont(fonts.small);
  ImGui::TextDisabled("%s", text);
  ImGui::PopFont();
}

// A button that stays lit while `on`.
bool lit_button(const char* label, bool on, const ImVec2& size) {
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, imgui_color(theme::kAccent));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, imgui_color(theme::kAccent));
    ImGui::PushStyleColor(ImGuiCol_Text, imgui_color(theme::kDesk));
  }
  const bool pressed = ImGui::Button(label, size);
  if (on) ImGui::PopStyleColor(3);
  return pressed;
}

void draw_palette(const Fonts& fonts, const Scene& scene, Choices& choices, Presses& presses) {
  heading(fonts, "Click inserts");
  const std::vector<std::string>& names = mesh_names();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float count = static_cast<float>(names.size());
  const float width = (ImGui::GetContentRegionAvail().x - (count - 1) * gap) / count;
  for (const std::string& mesh : names) {
    if (lit_button(mesh.c_str(), choices.insert == mesh, {width, 0}))
      choices.insert = choices.insert == mesh ? std::string() : mesh;
    if (&mesh != &names.back()) ImGui::SameLine();
  }
  const bool selected = std::any_of(scene.objects.begin(), scene.objects.end(),
                                    [](const VirtualObject& object) { return object.selected; });
  const float half = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  if (!selected) ImGui::BeginDisabled();
  presses.delete_selected = ImGui::Button("Delete", {half, 0});
  if (!selected) ImGui::EndDisabled();
  ImGui::SameLine();
  if (lit_button("Inliers", choices.show_inliers, {half, 0}))
    choices.show_inliers = !choices.show_inliers;
  ImGui::SameLine();
  presses.wearer_layout = ImGui::Button("Wearer", {half, 0});
}

void draw_stages(const Fonts& fonts, const Scene& scene) {
  heading(fonts, "Stages");
  if (!ImGui::BeginTable("stages", 6, ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 2.1F);
  for (const char* column : {"frames", "drops", "p50", "p95", "p99 ms"})
    ImGui::TableSetupColumn(column, ImGuiTableColumnFlags_WidthStretch, 1.25F);
  const auto right_aligned = [](const std::string& text) {
    const float space = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (space > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + space);
    ImGui::TextUnformatted(text.c_str());
  };
  ImGui::PushFont(fonts.small);
  ImGui::PushStyleColor(ImGuiCol_Text, imgui_color(theme::kQuiet));
  ImGui::TableNextRow();
  for (const char* column : {"", "frames", "drops", "p50", "p95", "p99 ms"}) {
    ImGui::TableNextColumn();
    right_aligned(column);
  }
  ImGui::PopStyleColor();
  ImGui::PopFont();
  ImGui::PushFont(fonts.figures);
  for (const StageRow& row : scene.stages) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.name.c_str());
    for (const std::string& cell :
         {std::to_string(row.frames), std::to_string(row.drops), fixed(1e3 * row.p50, 1),
          fixed(1e3 * row.p95, 1), fixed(1e3 * row.p99, 1)}) {
      ImGui::TableNextColumn();
      right_aligned(cell);
    }
  }
  ImGui::PopFont();
  ImGui::EndTable();
}

}  // namespace

theme::Color state_color(const std::string& state) {
  if (state == "tracking" || state == "relocalised") return theme::kGood;
  if (state == "lost") return theme::kBad;
  return theme::kWarning;
}

void draw_wearer_overlay(const Fonts& fonts, const Scene& scene, const Rectangle& picture) {
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float margin = 12;
  const theme::Color state = state_color(scene.tracking_state);
  const ImVec2 corner = corner_of(picture);
  if (!scene.tracking_state.empty())
    draw_pill(list, *fonts.text, {corner.x + margin, corner.y + margin}, scene.tracking_state,
              &state);
  draw_messages(list, fonts, scene, picture);
}

void draw_messages(ImDrawList& list, const Fonts& fonts, const Scene& scene,
                   const Rectangle& view) {
  const float margin = 12;
  const float left = static_cast<float>(view.x) + margin;
  float bottom = static_cast<float>(view.y + view.height) - margin;
  int shown = 0;
  for (auto message = scene.messages.rbegin(); message != scene.messages.rend() && shown < 3;
       ++message, ++shown) {
    const theme::Color color = severity_color(message->severity);
    bottom -= pill_size(*fonts.text, message->text, true).y;
    draw_pill(list, *fonts.text, {left, bottom}, message->text, &color);
    bottom -= 6;
  }
}

void draw_header(const Fonts& fonts, const Scene& scene, const Rectangle& place) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float middle = static_cast<float>(place.y) + static_cast<float>(place.height) / 2;
  const auto text = [&](ImFont& font, float x, const theme::Color& color,
                        const std::string& words) {
    const float y = std::round(middle - font.FontSize / 2);
    list.AddText(&font, font.FontSize, {x, y}, imgui_color(color), words.c_str());
    return x + font.CalcTextSizeA(font.FontSize, 1e6F, 0, words.c_str()).x;
  };
  float x = text(*fonts.strong, static_cast<float>(place.x) + 4, theme::kInk, "Armsreach") + 18;
  const theme::Color color = state_color(scene.tracking_state);
  const std::string state = state_or_idle(scene);
  x +=
      draw_pill(list, *fonts.text, {x, middle - pill_size(*fonts.text, state).y / 2}, state, &color)
          .x;

  // From the right, the most important first, each in a slot of fixed width so that nothing dances.
  const std::array<std::pair<const char*, std::string>, 6> figures{{
      {"latency", fixed(1e3 * scene.latency, 0) + " ms"},
      {"rate", fixed(scene.frame_rate, 1) + " Hz"},
      {"inliers", std::to_string(scene.tracking_inliers)},
      {"rms", fixed(scene.tracking_rms, 2)},
      {"frame", std::to_string(scene.frame)},
      {"time", fixed(scene.time, 2) + " s"},
  }};
  const float slot = 124;
  float at = static_cast<float>(place.x + place.width);
  for (const auto& [name, value] : figures) {
    at -= slot;
    if (at < x + 12) break;
    text(*fonts.figures, text(*fonts.small, at, theme::kQuiet, name) + 7, theme::kInk, value);
  }
}

Presses draw_side_panel(const Fonts& fonts, const Scene& scene, const Rectangle& place,
                        Choices& choices) {
  Presses presses;
  if (begin_panel("side", place)) {
    draw_palette(fonts, scene, choices, presses);
    ImGui::Dummy({0, 4});
    if (!scene.stages.empty()) draw_stages(fonts, scene);
  }
  ImGui::End();
  return presses;
}

}  // namespace armsreach::render
