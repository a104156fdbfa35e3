#include "renderer/gl/debug.h"

#include "renderer/gl/debug_log.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <utility>

namespace celadon::gl {

namespace {

/// A program that fails in every call of every frame shall not fill the memory as well.
constexpr std::size_t kMaxMessages = 1000;

/// Performance hints and vendors' free talk come with medium severity from some drivers, and are no
/// faults. A shader that does not compile is reported by Program, with the file and line, and may
/// be expected (someone is editing it).
bool isFault(GLenum source, GLenum type, GLenum severity) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER || type == GL_DEBUG_TYPE_PERFORMANCE) {
        return false;
    }
    if (type == GL_DEBUG_TYPE_OTHER) {
        return severity == GL_DEBUG_SEVERITY_HIGH;
    }
    return severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM;
}

const char* typeName(GLenum type) {
    switch (type) {
    case GL_DEBUG_TYPE_ERROR:
        return "error";
    case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
        return "undefined behavior";
    case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR:
        return "deprecated";
    case GL_DEBUG_TYPE_PORTABILITY:
        return "portability";
    default:
        return "message";
    }
}

/// The words by which drivers name objects: "Buffer object 3 (bound to …)", "texture 7".
constexpr std::array<std::pair<std::string_view, GLenum>, 6> kObjectWords{{
    {"buffer", GL_BUFFER},
    {"texture", GL_TEXTURE},
    {"framebuffer", GL_FRAMEBUFFER},
    {"program", GL_PROGRAM},
    {"shader", GL_SHADER},
    {"sampler", GL_SAMPLER},
}};

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return lower;
}

/// The number that follows "word [object] " at `position`, which is the first letter of the word.
std::optional<GLuint> numberAfter(std::string_view lower, std::size_t position) {
    std::size_t i = position;
    const auto skip = [&](std::string_view expected) {
        if (lower.substr(i).starts_with(expected)) {
            i += expected.size();
            return true;
        }
        return false;
    };
    skip(" object");
    skip(" name");
    if (!skip(" ")) {
        return std::nullopt;
    }
    skip("#");
    const std::size_t first = i;
    GLuint number = 0;
    while (i < lower.size() && i - first < 9 &&
           std::isdigit(static_cast<unsigned char>(lower[i]))) {
        number = number * 10 + static_cast<GLuint>(lower[i] - '0');
        ++i;
    }
    return i > first ? std::optional(number) : std::nullopt;
}

std::string labelOf(GLenum identifier, GLuint name) {
    const bool exists = (identifier == GL_BUFFER && glIsBuffer(name)) ||
                        (identifier == GL_TEXTURE && glIsTexture(name)) ||
                        (identifier == GL_FRAMEBUFFER && glIsFramebuffer(name)) ||
                        (identifier == GL_PROGRAM && glIsProgram(name)) ||
                        (identifier == GL_SHADER && glIsShader(name)) ||
                        (identifier == GL_SAMPLER && glIsSampler(name));
    if (!exists) {
        return {};
    }
    std::array<char, 257> label{};
    GLsizei length = 0;
    glGetObjectLabel(identifier, name, static_cast<GLsizei>(label.size()), &length, label.data());
    return std::string(label.data(), static_cast<std::size_t>(length));
}

/// Appends the labels of objects that the message mentions by number. Not done within the callback,
/// which may call no GL.
std::string withLabels(std::string message) {
    const std::string lower = lowerCase(message);
    std::string labels;
    for (const auto& [word, identifier] : kObjectWords) {
        for (std::size_t at = lower.find(word); at != std::string::npos;
             at = lower.find(word, at + 1)) {
            const bool wholeWord =
                at == 0 || !std::isalpha(static_cast<unsigned char>(lower[at - 1]));
            const auto number = wholeWord ? numberAfter(lower, at + word.size()) : std::nullopt;
            const std::string label = number ? labelOf(identifier, *number) : std::string();
            if (!label.empty()) {
                labels += labels.empty() ? " (" : ", ";
                labels.append(word).append(" ").append(std::to_string(*number));
                labels.append(" is '").append(label).append("'");
            }
        }
    }
    if (!labels.empty()) {
        message += labels + ")";
    }
    return message;
}

} // namespace

void GLAD_API_PTR Context::DebugLog::callback(GLenum source, GLenum type, GLuint, GLenum severity,
                                              GLsizei length, const GLchar* text, const void* log) {
    const std::string_view message =
        length >= 0 ? std::string_view(text, static_cast<std::size_t>(length)) : text;
    static_cast<DebugLog*>(const_cast<void*>(log))->receive(source, type, severity, message);
}

void Context::DebugLog::receive(GLenum source, GLenum type, GLenum severity,
                                std::string_view text) {
    const std::lock_guard lock(mutex);
    // Groups report themselves, which spares a second list beside the driver's.
    if (type == GL_DEBUG_TYPE_PUSH_GROUP) {
        groups.emplace_back(text);
        return;
    }
    if (type == GL_DEBUG_TYPE_POP_GROUP) {
        if (!groups.empty()) {
            groups.pop_back();
        }
        return;
    }
    if (!isFault(source, type, severity) || messages.size() >= kMaxMessages) {
        return;
    }
    std::string message = "GL ";
    message += typeName(type);
    for (const std::string& group : groups) {
        message += &group == &groups.front() ? " in '" : " > '";
        message += group + "'";
    }
    message.append(": ").append(text);
    while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back()))) {
        message.pop_back();
    }
    messages.push_back(std::move(message));
}

void Context::DebugLog::attach() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&DebugLog::callback, this);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
}

std::vector<std::string> Context::takeDebugMessages() {
    std::vector<std::string> messages;
    {
        const std::lock_guard lock(mDebugLog->mutex);
        messages.swap(mDebugLog->messages);
    }
    if (current() == this) {
        for (std::string& message : messages) {
            message = withLabels(std::move(message));
        }
    }
    return messages;
}

void labelObject(GLenum identifier, GLuint name, std::string_view label) {
    // GL_MAX_LABEL_LENGTH is at least 256, the terminating zero included.
    glObjectLabel(identifier, name, static_cast<GLsizei>(std::min<std::size_t>(label.size(), 255)),
                  label.data());
}

DebugGroup::DebugGroup(std::string_view name) {
    // GL_MAX_DEBUG_MESSAGE_LENGTH may be as small as 1; every driver has at least 1024.
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0,
                     static_cast<GLsizei>(std::min<std::size_t>(name.size(), 255)), name.data());
}

DebugGroup::~DebugGroup() {
    glPopDebugGroup();
}

} // namespace celadon::gl
