// Registrations of a sequence's meshes, kept on disk while the work lasts: interrupted, it goes on
// after the last frame that is there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "learning/registration/registration.h"

namespace vitruvia {

class RegistrationLog {
 public:
  RegistrationLog() = default;  // kept in memory only
  // Takes over what the file holds if it was written under the same key; otherwise begins anew. A
  // last line that was cut off is dropped.
  RegistrationLog(std::filesystem::path file, std::string key);

  const std::vector<Registration>& registrations() const { return registrations_; }
  // Of the next frame. RunError if it cannot be written.
  void Append(const Registration& registration);
  // The file, once its content is no longer needed.
  void Remove() const;

 private:
  std::filesystem::path file_;
  std::string key_;
  std::vector<Registration> registrations_;
};

}  // namespace vitruvia
