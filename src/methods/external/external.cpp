#include "methods/external/external.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "methods/external/piped_program.h"

namespace vitruvia::external {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "the protocol is little-endian");
static_assert(sizeof(Vector3f) == 3 * sizeof(float), "the protocol packs vectors");

constexpr int kProtocolVersion = 1;
constexpr std::size_t kShownOfLine = 80;

// The subject's files, for the program to read; removed at the end.
class SubjectFolder {
 public:
  explicit SubjectFolder(const Subject& subject) {
    std::string pattern = (TemporaryDirectory() / "vitruvia-subject-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw RunError(fmt::format("{}: folder cannot be made", pattern));
    path_ = pattern;
    WriteBodyModel(path_, subject);
  }
  ~SubjectFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  SubjectFolder(const SubjectFolder&) = delete;
  SubjectFolder& operator=(const SubjectFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// One answer of the program, checked piece by piece.
class Answer {
 public:
  Answer(const PipedProgram& program, std::string where, std::string line)
      : program_(program), where_(std::move(where)), line_(std::move(line)) {
    json_ = Json::parse(line_, nullptr, false);
    if (!json_.is_object()) Fail("a line with a JSON object");
  }

  [[noreturn]] void Fail(const std::string& expected) const {
    program_.Fail(
        fmt::format("{}: expected {}, got {}", where_, expected, line_.substr(0, kShownOfLine)));
  }

  void RequireType(const std::string& type) const {
    if (json_.value("type", Json()) != Json(type)) Fail(fmt::format("\"type\": \"{}\"", type));
  }

  Outcome outcome() const {
    const Json name = json_.value("outcome", Json());
    for (const Outcome outcome :
         {Outcome::kConverged, Outcome::kIterationLimit, Outcome::kLost, Outcome::kNoData}) {
      if (name == Json(Name(outcome))) return outcome;
    }
    Fail("\"outcome\": converged, iteration_limit, lost or no_data");
  }

  std::string message() const {
    const Json text = json_.value("message", Json(""));
    if (!text.is_string()) Fail("\"message\": a text");
    return text.get<std::string>();
  }

  int iterations() const {
    const Json number = json_.value("iterations", Json(0));
    if (!number.is_number_integer() || number < 0) Fail("\"iterations\": a whole number");
    return number.get<int>();
  }

  std::vector<Vector3<double>> joints() const {
    const Json list = json_.value("joints", Json());
    if (!list.is_array() || list.size() != kBoneCount)
      Fail(fmt::format("\"joints\": {} points", kBoneCount));
    std::vector<Vector3<double>> joints;
    for (const Json& point : list) {
      if (!point.is_array() || point.size() != 3) Fail("\"joints\": points of 3 numbers");
      Vector3<double> joint;
      for (int k = 0; k < 3; ++k) {
        if (!point[k].is_number()) Fail("\"joints\": points of 3 numbers");
        joint[k] = point[k].get<double>();
      }
      joints.push_back(joint);
    }
    return joints;
  }

  // A list of pairs of a name and a number; none if the key is absent.
  std::vector<NamedValue> Named(const char* key) const {
    const Json list = json_.value(key, Json::array());
    if (!list.is_array()) Fail(fmt::format("\"{}\": a list", key));
    std::vector<NamedValue> values;
    for (const Json& pair : list) {
      const bool valid =
          pair.is_array() && pair.size() == 2 && pair[0].is_string() && pair[1].is_number();
      if (!valid) Fail(fmt::format("\"{}\": pairs of a name and a number", key));
      values.push_back({pair[0].get<std::string>(), pair[1].get<double>()});
    }
    return values;
  }

 private:
  const PipedProgram& program_;
  std::string where_, line_;
  Json json_;
};

Json StartMessage(const Subject& subject, const PinholeCamera& camera, const fs::path& folder) {
  Json joints = Json::array();
  for (const BoneInfo& bone : Bones()) joints.push_back(bone.joint);
  return {{"type", "start"},
          {"version", kProtocolVersion},
          {"camera",
           {{"width", camera.width},
            {"height", camera.height},
            {"fx", camera.fx},
            {"fy", camera.fy},
            {"cx", camera.cx},
            {"cy", camera.cy}}},
          {"subject", folder.string()},
          {"vertices", subject.rest.vertices.size()},
          {"joints", joints}};
}

}  // namespace

struct External::Session {
  Session(const Settings& settings, const Subject& subject)
      : folder(subject),
        program(settings.program, settings.arguments, settings.answer_within_s),
        vertex_count(subject.rest.vertices.size()) {}

  void Say(const Json& message) {
    const std::string line = message.dump() + "\n";
    program.Write(line.data(), line.size());
  }

  std::vector<Vector3f> ReadVertices(const std::string& where) {
    std::vector<Vector3f> vertices(vertex_count);
    program.Read(vertices.data(), vertices.size() * sizeof(Vector3f));
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (!vertices[v].allFinite())
        program.Fail(fmt::format("{}: expected finite vertices, vertex {} is not", where, v));
    }
    return vertices;
  }

  // Records hold one series for each name.
  void RequireSameNames(const TrackResult& result, const Answer& answer) {
    std::vector<std::string> frame_names;
    for (const NamedValue& value : result.energies) frame_names.push_back(value.name);
    frame_names.emplace_back();
    for (const NamedValue& value : result.step_ms) frame_names.push_back(value.name);
    if (names.empty()) names = frame_names;
    if (names != frame_names) answer.Fail("the energies and steps of the first frame");
  }

  SubjectFolder folder;
  PipedProgram program;
  std::size_t vertex_count;
  std::vector<std::string> names;  // of energies and steps, as the first frame has them
};

External::External(const Settings& settings) : settings_(settings) {}
External::~External() = default;

void External::Start(const Subject& subject, const PinholeCamera& camera) {
  session_.reset();
  session_ = std::make_unique<Session>(settings_, subject);
  session_->Say(StartMessage(subject, camera, session_->folder.path()));
  const Answer answer(session_->program, "start", session_->program.ReadLine());
  answer.RequireType("ready");
}

TrackResult External::TrackFrame(const DepthFrame& frame) {
  Require(session_ != nullptr, "TrackFrame before Start");
  const std::string where = fmt::format("frame {}", frame.index);
  const std::vector<float>& depth = frame.depth.pixels();
  session_->Say({{"type", "frame"},
                 {"index", frame.index},
                 {"time_s", frame.time_s},
                 {"depth_bytes", depth.size() * sizeof(float)}});
  session_->program.Write(depth.data(), depth.size() * sizeof(float));

  const Answer answer(session_->program, where, session_->program.ReadLine());
  answer.RequireType("estimate");
  TrackResult result;
  result.outcome = answer.outcome();
  result.message = answer.message();
  result.iterations = answer.iterations();
  result.joints = answer.joints();
  result.energies = answer.Named("energies");
  result.step_ms = answer.Named("step_ms");
  session_->RequireSameNames(result, answer);
  result.vertices = session_->ReadVertices(where);
  return result;
}

}  // namespace vitruvia::external
