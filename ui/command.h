#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Every action of a user is a command: a name and arguments, one line of JSON. Widgets, tools and
/// keys only make commands; one dispatcher executes them. So whatever can be done can be recorded,
/// replayed and tested without a window.
namespace celadon::ui {

struct Command {
    std::string name; ///< "camera.orbit"
    nlohmann::json arguments = nlohmann::json::object();
};

/// {"command": NAME, ARGUMENTS...} on one line, keys sorted, numbers such that they read back the
/// same.
[[nodiscard]] std::string formatCommand(const Command& command);
/// @throws UsageError: no JSON object, no "command"
[[nodiscard]] Command parseCommand(std::string_view line);

/// The arguments of a command, checked as they are taken.
class Arguments {
public:
    explicit Arguments(const Command& command) : mCommand(command) {}

    /// @throws UsageError naming command and argument: missing, wrong type, not finite
    [[nodiscard]] double number(const char* name) const;
    [[nodiscard]] double number(const char* name, double fallback) const;
    /// Within [least, most]. @throws UsageError
    [[nodiscard]] double numberWithin(const char* name, double least, double most) const;
    [[nodiscard]] int integerWithin(const char* name, int least, int most) const;
    [[nodiscard]] bool flag(const char* name) const;
    [[nodiscard]] bool flag(const char* name, bool fallback) const;
    [[nodiscard]] std::string text(const char* name) const;
    [[nodiscard]] std::string text(const char* name, const std::string& fallback) const;
    [[nodiscard]] glm::dvec2 vector2(const char* name) const;
    [[nodiscard]] glm::dvec3 vector3(const char* name) const;
    [[nodiscard]] std::vector<double> numbers(const char* name) const;
    [[nodiscard]] bool has(const char* name) const { return mCommand.arguments.contains(name); }
    [[nodiscard]] const nlohmann::json& value(const char* name) const;

private:
    [[noreturn]] void refuse(const char* name, const std::string& reason) const;

    const Command& mCommand;
};

[[nodiscard]] nlohmann::json toJson(glm::dvec3 v);

class Dispatcher {
public:
    using Handler = std::function<void(const Arguments&)>;

    struct Entry {
        std::string summary; ///< for help and tooltips
        Handler handler;
        bool isRecorded = true; ///< false: what concerns the window only, and queries
        bool isLong = false;    ///< may take longer than a frame
    };

    /// @param name not registered before
    void add(const std::string& name, const std::string& summary, Handler handler,
             bool isRecorded = true);
    /// The same for what may take longer than a frame.
    /// @param isRecorded false: by the handler, when it is done, as what it came to
    void addLong(const std::string& name, const std::string& summary, Handler handler,
                 bool isRecorded = false);
    /// @throws UsageError for an unknown command, one with an argument of the wrong type; whatever
    ///         the handler throws. Observers hear of commands that succeeded.
    void execute(const Command& command);
    /// Tells the observers of a command that was carried out by other means (on a thread).
    void announce(const Command& command);
    void observe(std::function<void(const Command&)> observer);

    [[nodiscard]] bool knows(const std::string& name) const { return mEntries.contains(name); }
    [[nodiscard]] bool isLong(const std::string& name) const {
        const auto found = mEntries.find(name);
        return found != mEntries.end() && found->second.isLong;
    }
    [[nodiscard]] const std::map<std::string, Entry>& entries() const { return mEntries; }

private:
    void insert(const std::string& name, Entry entry);

    std::map<std::string, Entry> mEntries;
    std::vector<std::function<void(const Command&)>> mObservers;
};

} // namespace celadon::ui
