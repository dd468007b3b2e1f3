#include "subjects/registration_log.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <optional>

#include "config/json_settings.h"
#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

template <class Vector>
Json ListOf(const Vector& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

template <class Vector>
void Fill(const Json& list, Vector& values) {
  const auto numbers = list.get<std::vector<double>>();
  if constexpr (Vector::SizeAtCompileTime == Eigen::Dynamic) {
    values.resize(static_cast<Eigen::Index>(numbers.size()));
  }
  if (static_cast<Eigen::Index>(numbers.size()) != values.size())
    throw DataError("registration log: a list of another length");
  std::copy(numbers.begin(), numbers.end(), values.data());
}

// Numbers are written so that they are read back to the last bit; an infinite margin as null.
Json Written(const Registration& r) {
  const MutualDistance& d = r.distance;
  return {
      {"rotation", ListOf(r.state.rotation)},
      {"pelvis", ListOf(r.state.pelvis_position)},
      {"angles_deg", ListOf(r.state.angles_deg)},
      {"theta", ListOf(r.state.theta)},
      {"distance", {d.target_to_body_m, d.body_to_target_m, d.target_explained, d.body_explained}},
      {"margin", std::isfinite(r.margin) ? Json(r.margin) : Json()},
      {"start", r.start}};
}

// Nothing if the line is not whole.
std::optional<Registration> Read(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    Registration r;
    Fill(json.at("rotation"), r.state.rotation);
    Fill(json.at("pelvis"), r.state.pelvis_position);
    Fill(json.at("angles_deg"), r.state.angles_deg);
    Fill(json.at("theta"), r.state.theta);
    const Json& d = json.at("distance");
    r.distance = {d.at(0), d.at(1), d.at(2), d.at(3)};
    r.margin = json.at("margin").is_null() ? std::numeric_limits<double>::infinity()
                                           : json.at("margin").get<double>();
    r.start = json.at("start");
    return r;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const DataError&) {
    return std::nullopt;
  }
}

}  // namespace

RegistrationLog::RegistrationLog(fs::path file, std::string key)
    : file_(std::move(file)), key_(std::move(key)) {
  std::string content = key_ + '\n';
  std::ifstream stream(file_);
  std::string line;
  if (std::getline(stream, line) && line == key_) {
    while (std::getline(stream, line)) {
      std::optional<Registration> registration = Read(line);
      if (!registration) break;
      registrations_.push_back(std::move(*registration));
      content += line + '\n';
    }
  }
  if (!registrations_.empty()) WriteWholeFile(file_, content);
}

void RegistrationLog::Append(const Registration& registration) {
  registrations_.push_back(registration);
  if (file_.empty()) return;
  if (registrations_.size() == 1) WriteWholeFile(file_, key_ + '\n');
  std::ofstream stream(file_, std::ios::app);
  stream << Written(registration).dump() << std::endl;
  if (!stream) throw RunError(fmt::format("{}: cannot be written", file_.string()));
}

void RegistrationLog::Remove() const {
  std::error_code not_there;
  if (!file_.empty()) fs::remove(file_, not_there);
}

}  // namespace vitruvia
