#include "methods/external/piped_program.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "core/error.h"
#include "core/progress.h"

namespace vitruvia::external {
namespace {

constexpr int kLookForInterruptEvery_ms = 100;
constexpr std::size_t kLongestLine = 1 << 20;
constexpr std::chrono::milliseconds kMayTakeToEnd{1000}, kAskWhetherEndedEvery{5};
constexpr int kCouldNotStart = 127;

// In the child: becomes the program, its input and output the socket.
[[noreturn]] void Become(const std::vector<std::string>& words, int socket) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(socket, STDIN_FILENO);
  dup2(socket, STDOUT_FILENO);
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execv(argv.front(), argv.data());
  _exit(kCouldNotStart);
}

}  // namespace

PipedProgram::PipedProgram(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments, double answer_within_s)
    : name_(program.string()), answer_within_(answer_within_s) {
  if (access(program.c_str(), X_OK) != 0)
    throw ConfigError(fmt::format("{}: cannot be started: {}", name_, std::strerror(errno)));
  std::vector<std::string> words = {name_};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    Fail(fmt::format("no socket: {}", std::strerror(errno)));
  process_ = fork();
  if (process_ == 0) Become(words, ends[1]);
  close(ends[1]);
  socket_ = ends[0];
  if (process_ < 0) {
    close(socket_);
    Fail(fmt::format("no new process: {}", std::strerror(errno)));
  }
  fcntl(socket_, F_SETFL, O_NONBLOCK);
}

PipedProgram::~PipedProgram() {
  close(socket_);
  const auto end = std::chrono::steady_clock::now() + kMayTakeToEnd;
  while (waitpid(process_, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) kill(process_, SIGKILL);
    std::this_thread::sleep_for(kAskWhetherEndedEvery);
  }
}

void PipedProgram::Write(const void* data, std::size_t bytes) {
  const Deadline deadline = NextDeadline();
  const char* at = static_cast<const char*>(data);
  while (bytes > 0) {
    Await(POLLOUT, deadline);
    const ssize_t sent = send(socket_, at, bytes, MSG_NOSIGNAL);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (sent < 0) Fail("has ended before it was given all of its input");
    at += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
}

std::string PipedProgram::ReadLine() {
  const Deadline deadline = NextDeadline();
  std::size_t end = 0;
  while ((end = received_.find('\n')) == std::string::npos) {
    if (received_.size() > kLongestLine)
      Fail(fmt::format("expected a line, got {} bytes without an end", received_.size()));
    Receive(deadline);
  }
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
}

void PipedProgram::Read(void* data, std::size_t bytes) {
  const Deadline deadline = NextDeadline();
  while (received_.size() < bytes) Receive(deadline);
  std::copy_n(received_.begin(), bytes, static_cast<char*>(data));
  received_.erase(0, bytes);
}

void PipedProgram::Fail(const std::string& problem) const {
  throw RunError(fmt::format("{}: {}", name_, problem));
}

PipedProgram::Deadline PipedProgram::NextDeadline() const {
  return std::chrono::steady_clock::now() +
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(answer_within_);
}

void PipedProgram::Await(short events, Deadline deadline) const {
  pollfd waiting{socket_, events, 0};
  while (poll(&waiting, 1, kLookForInterruptEvery_ms) <= 0) {
    ThrowIfInterrupted();
    if (std::chrono::steady_clock::now() > deadline)
      Fail(fmt::format("no answer within {} s", answer_within_.count()));
  }
}

void PipedProgram::Receive(Deadline deadline) {
  std::array<char, 65536> buffer;
  Await(POLLIN, deadline);
  const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
  const bool gone = count == 0 || (count < 0 && errno == ECONNRESET);
  if (gone) Fail(fmt::format("has ended; {} bytes of an answer were there", received_.size()));
  if (count > 0) received_.append(buffer.data(), static_cast<std::size_t>(count));
}

}  // namespace vitruvia::external
