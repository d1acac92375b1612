#include "tools/cli/exit_code.hpp"

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/record/errors.hpp"
#include "tools/render/errors.hpp"

namespace ghtrack::cli {
namespace {

constexpr int kEnvironmentFailed = 1;
constexpr int kInputWrong = 2;

int interrupted_by(int signal, const std::string& remark) {
  tell("ghtrack: interrupted; {}", remark);
  return 128 + signal;
}

/// A signal also ends what waits for a file or a pipe, as an error that is none.
int failed(int exit_code, const std::string& message) {
  if (const auto signal = signal_received()) return interrupted_by(*signal, "nothing was written");
  tell_line(message);
  return exit_code;
}

}  // namespace

int exit_code_of(const std::function<int()>& command) try {
  const int exit_code = command();
  finish_printing();
  if (const auto signal = signal_received(); signal && exit_code == 0) {
    return interrupted_by(*signal, "all was done already");
  }
  return exit_code;
} catch (const SceneError& error) {
  return failed(kInputWrong, error.what());
} catch (const InputError& error) {
  return failed(kInputWrong, error.what());
} catch (const UsageError& error) {
  return failed(kInputWrong, std::string("ghtrack: error: ") + error.what());
} catch (const render::RequestError& error) {
  return failed(kInputWrong, std::string("ghtrack: error: ") + error.what());
} catch (const Interrupted& interrupted) {
  return interrupted_by(interrupted.signal, interrupted.remark);
} catch (const WriteError& error) {
  return failed(kEnvironmentFailed, error.what());
} catch (const std::bad_alloc&) {
  return failed(kEnvironmentFailed, "ghtrack: error: out of memory");
} catch (const std::exception& error) {
  return failed(kEnvironmentFailed, std::string("ghtrack: error: ") + error.what());
}

}  // namespace ghtrack::cli
