#include "ui/command.h"

#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <cmath>

namespace celadon::ui {

std::string formatCommand(const Command& command) {
    nlohmann::json line = command.arguments.is_object() ? command.arguments : nlohmann::json{};
    line["command"] = command.name;
    return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Command parseCommand(std::string_view line) {
    nlohmann::json value = nlohmann::json::parse(line, nullptr, false);
    if (!value.is_object()) {
        throw UsageError("command", "a line is no JSON object");
    }
    const auto name = value.find("command");
    if (name == value.end() || !name->is_string()) {
        throw UsageError("command", "a line has no \"command\" that is a text");
    }
    Command command{name->get<std::string>()};
    value.erase("command");
    command.arguments = std::move(value);
    return command;
}

void Arguments::refuse(const char* name, const std::string& reason) const {
    throw UsageError(fmt::format("command '{}', argument '{}'", mCommand.name, name), reason);
}

const nlohmann::json& Arguments::value(const char* name) const {
    const auto found = mCommand.arguments.find(name);
    if (found == mCommand.arguments.end()) {
        refuse(name, "is missing");
    }
    return *found;
}

double Arguments::number(const char* name) const {
    const nlohmann::json& found = value(name);
    if (!found.is_number() || !std::isfinite(found.get<double>())) {
        refuse(name, "is not a finite number");
    }
    return found.get<double>();
}

double Arguments::number(const char* name, double fallback) const {
    return has(name) ? number(name) : fallback;
}

double Arguments::numberWithin(const char* name, double least, double most) const {
    const double found = number(name);
    if (found < least || found > most) {
        refuse(name, fmt::format("{:g} is not within {:g} to {:g}", found, least, most));
    }
    return found;
}

int Arguments::integerWithin(const char* name, int least, int most) const {
    const double found = numberWithin(name, least, most);
    if (found != std::floor(found)) {
        refuse(name, fmt::format("{:g} is not a whole number", found));
    }
    return static_cast<int>(found);
}

bool Arguments::flag(const char* name) const {
    const nlohmann::json& found = value(name);
    if (!found.is_boolean()) {
        refuse(name, "is neither true nor false");
    }
    return found.get<bool>();
}

bool Arguments::flag(const char* name, bool fallback) const {
    return has(name) ? flag(name) : fallback;
}

std::string Arguments::text(const char* name) const {
    const nlohmann::json& found = value(name);
    if (!found.is_string()) {
        refuse(name, "is not a text");
    }
    return found.get<std::string>();
}

std::string Arguments::text(const char* name, const std::string& fallback) const {
    return has(name) ? text(name) : fallback;
}

std::vector<double> Arguments::numbers(const char* name) const {
    const nlohmann::json& found = value(name);
    if (!found.is_array()) {
        refuse(name, "is not a list of numbers");
    }
    std::vector<double> result;
    for (const nlohmann::json& element : found) {
        if (!element.is_number() || !std::isfinite(element.get<double>())) {
            refuse(name, "holds something else than finite numbers");
        }
        result.push_back(element.get<double>());
    }
    return result;
}

glm::dvec2 Arguments::vector2(const char* name) const {
    const std::vector<double> found = numbers(name);
    if (found.size() != 2) {
        refuse(name, "is not a list of two numbers");
    }
    return {found[0], found[1]};
}

glm::dvec3 Arguments::vector3(const char* name) const {
    const std::vector<double> found = numbers(name);
    if (found.size() != 3) {
        refuse(name, "is not a list of three numbers");
    }
    return {found[0], found[1], found[2]};
}

nlohmann::json toJson(glm::dvec3 v) {
    return nlohmann::json::array({v.x, v.y, v.z});
}

void Dispatcher::insert(const std::string& name, Entry entry) {
    const bool added = mEntries.emplace(name, std::move(entry)).second;
    CELADON_ASSERT(added);
    static_cast<void>(added);
}

void Dispatcher::add(const std::string& name, const std::string& summary, Handler handler,
                     bool isRecorded) {
    insert(name, {summary, std::move(handler), isRecorded});
}

void Dispatcher::addLong(const std::string& name, const std::string& summary, Handler handler,
                         bool isRecorded) {
    insert(name, {summary, std::move(handler), isRecorded, true});
}

void Dispatcher::execute(const Command& command) {
    const auto found = mEntries.find(command.name);
    if (found == mEntries.end()) {
        throw UsageError(fmt::format("command '{}'", command.name), "there is no such command");
    }
    found->second.handler(Arguments(command));
    if (found->second.isRecorded) {
        announce(command);
    }
}

void Dispatcher::announce(const Command& command) {
    for (const auto& observer : mObservers) {
        observer(command);
    }
}

void Dispatcher::observe(std::function<void(const Command&)> observer) {
    mObservers.push_back(std::move(observer));
}

} // namespace celadon::ui
