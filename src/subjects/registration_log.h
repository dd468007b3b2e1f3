// Registrations of a sequence's meshes, stored on disk during the work, so that an interrupted run
// resumes after the last stored frame.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "learning/registration/registration.h"

namespace vitruvia {

class RegistrationLog {
 public:
  RegistrationLog() = default;  // kept in memory only
  // Loads the file's registrations if it was written with the same key; otherwise starts empty. An
  // incomplete last line is dropped.
  RegistrationLog(std::filesystem::path file, std::string key);

  const std::vector<Registration>& registrations() const { return registrations_; }
  // Appends the registration of the next frame. RunError if it cannot be written.
  void Append(const Registration& registration);
  // Deletes the file.
  void Remove() const;

 private:
  std::filesystem::path file_;
  std::string key_;
  std::vector<Registration> registrations_;
};

}  // namespace vitruvia
