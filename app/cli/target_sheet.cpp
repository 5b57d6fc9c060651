#include "app/cli/target_sheet.hpp"

#include <algorithm>
#include <cstdio>
#include <hpdf.h>
#include <memory>
#include <optional>

namespace armsreach::app {
namespace {

constexpr double kPointsPerMetre = 72 / 0.0254;
constexpr double kLongSide = 0.297;  // m, A4
constexpr double kShortSide = 0.210;
constexpr double kMargin = 0.012;  // m of white around it, for the corners to be seen against
constexpr double kScale = 0.1;     // m, the line to check the print by

HPDF_REAL points(double metres) { return static_cast<HPDF_REAL>(metres * kPointsPerMetre); }

void keep_error(HPDF_STATUS number, HPDF_STATUS, void* status) {
  *static_cast<HPDF_STATUS*>(status) = number;
}

struct FreeDocument {
  void operator()(HPDF_Doc document) const { HPDF_Free(document); }
};
using Document = std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, FreeDocument>;

void draw_rectangle(HPDF_Page page, double sheet_width, double sheet_height, double width,
                    double height) {
  HPDF_Page_SetRGBFill(page, 0, 0, 0);
  HPDF_Page_Rectangle(page, points((sheet_width - width) / 2), points((sheet_height - height) / 2),
                      points(width), points(height));
  HPDF_Page_Fill(page);
}

// Below the rectangle; thin and grey, so that it is no corner of anything.
void draw_scale(HPDF_Doc document, HPDF_Page page, double width, double height) {
  constexpr double kLeft = 0.012;  // m from the sheet's corner
  constexpr double kUp = 0.006;
  HPDF_Page_SetRGBStroke(page, 0.5F, 0.5F, 0.5F);
  HPDF_Page_SetLineWidth(page, 0.4F);
  HPDF_Page_MoveTo(page, points(kLeft), points(kUp));
  HPDF_Page_LineTo(page, points(kLeft + kScale), points(kUp));
  HPDF_Page_Stroke(page);
  char text[120];
  std::snprintf(text, sizeof text,
                "Armsreach start target %.1f x %.1f mm; the line is 100 mm: print at full size",
                1e3 * width, 1e3 * height);
  HPDF_Page_BeginText(page);
  HPDF_Page_SetFontAndSize(page, HPDF_GetFont(document, "Helvetica", nullptr), 7);
  HPDF_Page_SetRGBFill(page, 0.5F, 0.5F, 0.5F);
  HPDF_Page_TextOut(page, points(kLeft + kScale + 0.004), points(kUp) - 2, text);
  HPDF_Page_EndText(page);
}

// Width and height of the A4 page that has room for it, upright or across.
std::optional<std::pair<double, double>> sheet_for(double width, double height) {
  for (const auto& [w, h] : {std::pair(kLongSide, kShortSide), std::pair(kShortSide, kLongSide)}) {
    if (width <= w - 2 * kMargin && height <= h - 2 * kMargin) return std::pair(w, h);
  }
  return std::nullopt;
}

}  // namespace

Status write_target_sheet(const std::string& file, double width, double height) {
  const auto sheet = sheet_for(width, height);
  if (!sheet || !(std::min(width, height) >= 0.02)) {  // nor is a NaN a size
    return Error{"a rectangle of this size does not fit an A4 page", "--size",
                 "give between 20 and 273 mm for one side and 186 mm for the other"};
  }
  HPDF_STATUS failure = HPDF_OK;
  const Document document(HPDF_New(keep_error, &failure));
  if (!document) return Error{"no PDF can be made", file, "free some memory"};
  const HPDF_Page page = HPDF_AddPage(document.get());
  HPDF_Page_SetWidth(page, points(sheet->first));
  HPDF_Page_SetHeight(page, points(sheet->second));
  draw_rectangle(page, sheet->first, sheet->second, width, height);
  draw_scale(document.get(), page, width, height);
  HPDF_SaveToFile(document.get(), file.c_str());
  if (failure == HPDF_OK) return ok();
  return Error{"cannot be written", file, "give a path in a folder that is yours with --out"};
}

}  // namespace armsreach::app
