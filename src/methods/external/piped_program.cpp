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
#include <utility>

#include "core/error.h"
#include "core/progress.h"

namespace vitruvia::external {
namespace fs = std::filesystem;
namespace {

constexpr int kInterruptPollInterval_ms = 100;
constexpr std::size_t kMaxLineBytes = 1 << 20;
constexpr std::chrono::milliseconds kShutdownTimeout{1000}, kShutdownPollInterval{5};
constexpr int kExecFailed = 127;

std::vector<char*> Argv(std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  return argv;
}

// Runs in the child, where only async-signal-safe functions may be called. If the program cannot be
// executed, sends errno through `failure`; a successful execv closes that pipe.
[[noreturn]] void Execute(const std::vector<char*>& argv, int socket, int failure) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(socket, STDIN_FILENO);
  dup2(socket, STDOUT_FILENO);
  execv(argv.front(), argv.data());
  const int reason = errno;
  [[maybe_unused]] const ssize_t sent = write(failure, &reason, sizeof reason);
  _exit(kExecFailed);
}

// The errno that Execute sent; 0 if the pipe was closed by a successful execv.
int ReadFailure(int pipe) {
  int reason = 0;
  ssize_t count = 0;
  do {
    count = read(pipe, &reason, sizeof reason);
  } while (count < 0 && errno == EINTR);
  return count == sizeof reason ? reason : 0;
}

// A likely cause, if the system's error message alone would be misleading.
std::string LikelyCause(const fs::path& program, int reason) {
  std::error_code ignored;
  if (fs::is_directory(program, ignored)) return "; expected a file, this is a folder";
  if (reason == ENOEXEC) {
    return "; expected a program for this machine, or a script whose first line names its "
           "interpreter, such as \"#!/usr/bin/env python3\"";
  }
  if (reason == EACCES)
    return fmt::format("; the file may not be executed: chmod +x {}", program.string());
  if (reason == ENOENT && fs::exists(program, ignored))
    return "; the file is there, but not the interpreter that it asks for (its #! line)";
  return "";
}

std::string HowItEnded(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return fmt::format("was ended by signal {} ({})", signal, strsignal(signal));
  }
  return fmt::format("has ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    Close();
    fd_ = other.Release();
  }
  return *this;
}

void Descriptor::Close() {
  if (fd_ >= 0) close(fd_);
  fd_ = -1;
}

int Descriptor::Release() { return std::exchange(fd_, -1); }

PipedProgram::PipedProgram(const fs::path& program, const std::vector<std::string>& arguments,
                           double answer_within_s)
    : name_(program.string()), answer_within_(answer_within_s) {
  StartProcess(program, arguments);
  fcntl(socket_.get(), F_SETFL, O_NONBLOCK);
}

void PipedProgram::StartProcess(const fs::path& program,
                                const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {name_};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::vector<char*> argv = Argv(words);
  std::array<int, 2> sockets{}, pipe{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    Fail(fmt::format("no socket: {}", std::strerror(errno)));
  socket_ = Descriptor(sockets[0]);
  Descriptor socket_of_child(sockets[1]);
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) Fail(fmt::format("no pipe: {}", std::strerror(errno)));
  const Descriptor failure(pipe[0]);
  Descriptor failure_of_child(pipe[1]);

  process_ = fork();
  if (process_ < 0) Fail(fmt::format("no new process: {}", std::strerror(errno)));
  if (process_ == 0) Execute(argv, socket_of_child.get(), failure_of_child.get());
  socket_of_child.Close();
  failure_of_child.Close();
  const int reason = ReadFailure(failure.get());
  if (reason == 0) return;
  waitpid(process_, nullptr, 0);
  throw ConfigError(fmt::format("{}: cannot be started: {}{}", name_, std::strerror(reason),
                                LikelyCause(program, reason)));
}

PipedProgram::~PipedProgram() {
  socket_.Close();
  if (WaitForEnd()) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

void PipedProgram::Write(const void* data, std::size_t bytes) {
  const Deadline deadline = NextDeadline();
  const char* at = static_cast<const char*>(data);
  while (bytes > 0) {
    Await(POLLOUT, deadline);
    const ssize_t sent = send(socket_.get(), at, bytes, MSG_NOSIGNAL);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (sent < 0) FailBecauseGone("before it was given all of its input");
    at += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
}

std::string PipedProgram::ReadLine() {
  const Deadline deadline = NextDeadline();
  std::size_t end = 0;
  while ((end = received_.find('\n')) == std::string::npos) {
    if (received_.size() > kMaxLineBytes)
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
  pollfd waiting{socket_.get(), events, 0};
  while (poll(&waiting, 1, kInterruptPollInterval_ms) <= 0) {
    ThrowIfInterrupted();
    if (std::chrono::steady_clock::now() > deadline)
      Fail(fmt::format("no answer within {} s", answer_within_.count()));
  }
}

void PipedProgram::Receive(Deadline deadline) {
  std::array<char, 65536> buffer;
  Await(POLLIN, deadline);
  const ssize_t count = recv(socket_.get(), buffer.data(), buffer.size(), 0);
  const bool gone = count == 0 || (count < 0 && errno == ECONNRESET);
  if (gone) FailBecauseGone(fmt::format("after {} bytes of an answer", received_.size()));
  if (count > 0) received_.append(buffer.data(), static_cast<std::size_t>(count));
}

void PipedProgram::FailBecauseGone(const std::string& when) {
  const bool has_ended = WaitForEnd();
  Fail(fmt::format("{} {}", has_ended ? HowItEnded(status_) : "has closed its output", when));
}

bool PipedProgram::WaitForEnd() {
  if (process_ < 0) return true;
  const auto end = std::chrono::steady_clock::now() + kShutdownTimeout;
  while (waitpid(process_, &status_, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(kShutdownPollInterval);
  }
  process_ = -1;
  return true;
}

}  // namespace vitruvia::external
