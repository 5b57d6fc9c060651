#include "devices/rig.hpp"

#include <gtest/gtest.h>

#include "tests/unit/devices/broken_rig.hpp"
#include "tests/unit/devices/recorded_folder.hpp"

namespace armsreach {
namespace {

using test::RecordedFolder;

constexpr const char* kRig =
    "sensors:\n"
    "  - name: depth\n"
    "    source: tum:kitchen,loop=pingpong\n"
    "    camera: kinect.yaml\n"
    "    rig_from_sensor: {rotation_vector: [0, 0, 1.5], translation: [0.1, 0, 0]}\n"
    "  - {name: ir, source: 'images:infrared'}\n";

TEST(RigYaml, ReadsSensorsAndTheirPoses) {
  const auto rig = test::read_rig(kRig);
  ASSERT_TRUE(rig) << rig.error().message();
  ASSERT_EQ(rig->sensors.size(), 2U);
  const RigSensorSpec& depth = rig->sensors[0];
  EXPECT_EQ(depth.name, "depth");
  EXPECT_EQ(text_of(depth.source), "tum:kitchen,loop=pingpong");
  EXPECT_EQ(depth.camera, "kinect.yaml");
  EXPECT_NEAR(so3_log(depth.rig_from_sensor.rotation()).z(), 1.5, 1e-12);
  EXPECT_EQ(depth.rig_from_sensor.translation().x(), 0.1);
  EXPECT_EQ(rig->sensors[1].rig_from_sensor.translation().norm(), 0);
}

TEST(RigYaml, NamesTheLineAndTheEntryThatIsWrong) {
  const std::vector<test::BrokenRig> all = {
      {"sensors:", "sensor:", "rig.yaml:1", "'sensor'"},
      {"name: depth", "nam: depth", "rig.yaml:2", "'nam'"},
      {"    camera:", "    camra:", "rig.yaml:4", "'camra'"},
      {"translation:", "position:", "rig.yaml:5", "'position'"},
      {"name: depth", "name: ir", "rig.yaml:6", "two sensors are named 'ir'"},
      {"tum:kitchen", "kitchen", "rig.yaml:3", "no kind"},
      {"source: tum:kitchen,loop=pingpong", "source: [1]", "rig.yaml:3", "'source'"},
      {"    source: tum:kitchen,loop=pingpong\n", "", "rig.yaml:2", "'source' is missing"},
      {"1.5]", ".nan]", "rig.yaml:5", "'rotation_vector'"},
      {"0.1, 0, 0]", "0.1, 0]", "rig.yaml:5", "'translation'"},
      {"{rotation_vector: [0, 0, 1.5], ", "{", "rig.yaml:5", "'rotation_vector' is missing"},
      {"{name: ir, source: 'images:infrared'}", "ir", "rig.yaml:6", "not a map"},
      {kRig, "sensors: []", "rig.yaml:1", "no list of sensors"},
      {kRig, "just text", "rig.yaml:1", "not a map"},
      {kRig, "", "rig.yaml", ""},
      {kRig, "a: [1, 2", "rig.yaml", "YAML"},
  };
  test::expect_complaints(kRig, all);
}

TEST(RigFromSpecs, NamesSensors) {
  const auto one = rig_from_specs({"tum:dir,loop=pingpong"});
  ASSERT_TRUE(one) << one.error().message();
  EXPECT_EQ(one->sensors[0].name, "main");
  const auto two = rig_from_specs({"depth=tum:dir,loop=once", "ir=images:dir"});
  ASSERT_TRUE(two) << two.error().message();
  EXPECT_EQ(two->sensors[0].name, "depth");
  EXPECT_EQ(text_of(two->sensors[0].source), "tum:dir,loop=once");
  EXPECT_EQ(two->sensors[1].name, "ir");
  EXPECT_FALSE(rig_from_specs({}));
  EXPECT_FALSE(rig_from_specs({"tum:a", "tum:b"})) << "both would be main";
  EXPECT_FALSE(rig_from_specs({"depth=dir"}));
}

TEST(OpenRig, FindsFilesBesideTheRigFile) {
  const RecordedFolder folder;
  test::write_small_recording(folder);
  folder.write("rig.yaml", "sensors: [{name: depth, source: 'tum:.', camera: other.yaml}]");
  folder.write("other.yaml",
               "image_width: 32\nimage_height: 24\n"
               "camera_matrix: {data: [40, 0, 16, 0, 40, 12, 0, 0, 1]}\n");
  const auto spec = read_rig_file(folder / "rig.yaml");
  ASSERT_TRUE(spec) << spec.error().message();
  const auto rig = open_rig(*spec, std::nullopt);
  ASSERT_TRUE(rig) << rig.error().message();
  EXPECT_EQ((*rig)->sensors()[0].name(), "depth");
  EXPECT_EQ((*rig)->sensors()[0].source->sensor()->camera().fx, 40);
  EXPECT_FALSE((*rig)->live());
  EXPECT_FALSE(read_rig_file(folder / "absent.yaml"));
}

// A sensor with frames at given times; a negative one is a broken frame.
class MadeUpSource : public Source {
 public:
  MadeUpSource(const std::string& name, std::vector<Timestamp> times, bool is_live = false)
      : times_(std::move(times)), live_(is_live) {
    SensorInfo info;
    info.name = name;
    sensor_ = std::make_shared<SensorInfo>(info);
  }
  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  Result<FramePtr> next() override {
    if (next_ == times_.size() || stopped_) return FramePtr();
    auto frame = std::make_shared<Frame>();
    frame->time = times_[next_++];
    frame->sensor = sensor_;
    if (frame->time < 0) return Error{"broken", sensor_->name, "mend it"};
    return FramePtr(frame);
  }
  void stop() override { stopped_ = true; }
  Events take_events() override { return {Event{0, FaultEvent{sensor_->name, "", ""}}}; }
  bool live() const override { return live_; }

 private:
  std::vector<Timestamp> times_;
  bool live_;
  std::shared_ptr<const SensorInfo> sensor_;
  std::size_t next_ = 0;
  bool stopped_ = false;
};

class MadeUpActuator : public Actuator {
 public:
  explicit MadeUpActuator(bool* rested) : rested_(rested) {}
  const std::string& name() const override { return name_; }
  Status rest() override {
    *rested_ = true;
    return Error{"stuck", name_, "free it", Error::Kind::device};
  }

 private:
  std::string name_ = "gimbal";
  bool* rested_;
};

TEST(Rig, MergesItsSensorsByTime) {
  std::vector<RigSensor> sensors;
  sensors.push_back({std::make_unique<MadeUpSource>("a", std::vector<Timestamp>{1, 4, -1, 9}), {}});
  sensors.push_back({std::make_unique<MadeUpSource>("b", std::vector<Timestamp>{2, 3, 4, 5}), {}});
  Rig rig(std::move(sensors), {});
  std::string order;
  for (;;) {
    const auto frame = rig.next();
    if (!frame) {
      order += "broken ";
      continue;
    }
    if (!*frame) break;
    order += (*frame)->sensor->name + std::to_string((*frame)->time) + " ";
  }
  EXPECT_EQ(order, "a1 b2 b3 a4 broken b4 b5 a9 ");
  EXPECT_EQ(rig.next().value(), nullptr);
  EXPECT_EQ(rig.take_events().size(), 2U);
}

TEST(Rig, StopEndsSensorsAndRestsActuators) {
  bool rested = false;
  std::vector<RigSensor> sensors;
  sensors.push_back({std::make_unique<MadeUpSource>("a", std::vector<Timestamp>{1, 4}), {}});
  std::vector<std::shared_ptr<Actuator>> actuators;
  actuators.push_back(std::make_unique<MadeUpActuator>(&rested));
  Rig rig(std::move(sensors), std::move(actuators));
  ASSERT_TRUE(rig.next().value());
  rig.stop();
  EXPECT_EQ(rig.next().value(), nullptr);
  EXPECT_TRUE(rested);
}

TEST(OpenRig, RefusesSensorsWithoutACommonClockAndOneCameraForMany) {
  SourceKind kind;
  kind.name = "made-up";
  kind.open = [](const SourceSpec& spec,
                 const OpenOptions& options) -> Result<std::unique_ptr<Source>> {
    return std::make_unique<MadeUpSource>(options.sensor, std::vector<Timestamp>{0},
                                          spec.place == "live");
  };
  const auto mixed = rig_from_specs({"a=made-up:live", "b=made-up:recorded"});
  const auto refused = open_rig(*mixed, std::nullopt, {kind});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("'a' and 'b'"), std::string::npos);
  const auto same = rig_from_specs({"a=made-up:live", "b=made-up:live"});
  EXPECT_TRUE(open_rig(*same, std::nullopt, {kind}));
  EXPECT_FALSE(open_rig(*same, CameraFile{}, {kind}));
}

}  // namespace
}  // namespace armsreach
