// armsreach_bench_plot RUN.json FIGURES.json FOLDER: draws a benchmark run's figures as SVG.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "tests/bench/plot/figure.hpp"
#include "tests/bench/plot/svg.hpp"

namespace {

nlohmann::json read(const char* path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(std::string(path) + " cannot be opened");
  return nlohmann::json::parse(in);
}

std::string footer(const nlohmann::json& context) {
  char text[128];
  std::snprintf(text, sizeof(text), "one thread of %d at %d MHz, load %.1f; %.10s",
                context.at("num_cpus").get<int>(), context.at("mhz_per_cpu").get<int>(),
                context.at("load_avg").empty() ? 0.0 : context.at("load_avg")[0].get<double>(),
                context.at("date").get<std::string>().c_str());
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: armsreach_bench_plot RUN.json FIGURES.json FOLDER\n");
    return 2;
  }
  try {
    const nlohmann::json run = read(argv[1]);
    for (const nlohmann::json& spec : read(argv[2])) {
      const auto figure = armsreach::plot::make_figure(spec, run.at("benchmarks"));
      if (!figure) continue;
      const auto path = std::filesystem::path(argv[3]) / (figure->file + ".svg");
      std::ofstream out(path);
      armsreach::plot::write_svg(out, *figure, footer(run.at("context")));
      if (!out.flush()) throw std::runtime_error(path.string() + " cannot be written");
      std::printf("%s\n", path.c_str());
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "armsreach_bench_plot: %s\n", e.what());
    return 2;
  }
  return 0;
}
