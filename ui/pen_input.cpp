#include "ui/pen_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdlib>
#include <dlfcn.h>
#include <string>
#include <string_view>
#include <xcb/xcb.h>
#include <xcb/xinput.h>

namespace celadon::ui {

namespace {

/// What XCB gives is freed by its caller.
struct Free {
    void operator()(void* p) const { std::free(p); }
};
template<class T>
using Reply = std::unique_ptr<T, Free>;

double fromFixed(xcb_input_fp3232_t value) {
    return static_cast<double>(value.integral) + static_cast<double>(value.frac) / 4294967296.0;
}

double fromFixed(xcb_input_fp1616_t value) {
    return static_cast<double>(value) / 65536.0;
}

/// A GLFW for Wayland has no such function, so the linker is not to ask for it.
unsigned windowOf(GLFWwindow* window) {
    using Function = unsigned long (*)(GLFWwindow*);
    const auto find = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, "glfwGetX11Window"));
    return find != nullptr ? static_cast<unsigned>(find(window)) : 0u;
}

xcb_atom_t atomOf(xcb_connection_t* connection, std::string_view name) {
    const Reply<xcb_intern_atom_reply_t> reply(xcb_intern_atom_reply(
        connection,
        xcb_intern_atom(connection, 1, static_cast<std::uint16_t>(name.size()), name.data()),
        nullptr));
    return reply ? reply->atom : xcb_atom_t{XCB_ATOM_NONE};
}

bool isNamedEraser(const xcb_input_xi_device_info_t* device) {
    std::string name(xcb_input_xi_device_info_name(device),
                     static_cast<std::size_t>(xcb_input_xi_device_info_name_length(device)));
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name.find("eraser") != std::string::npos;
}

void select(xcb_connection_t* connection, xcb_window_t window, int device, std::uint32_t mask) {
    struct {
        xcb_input_event_mask_t head;
        std::uint32_t mask;
    } const wanted{{static_cast<xcb_input_device_id_t>(device), 1}, mask};
    xcb_input_xi_select_events(connection, window, 1, &wanted.head);
}

} // namespace

void PenInput::Disconnect::operator()(xcb_connection_t* connection) const {
    xcb_disconnect(connection);
}

PenInput::PenInput(GLFWwindow* window) : mWindow(windowOf(window)) {
    if (mWindow != 0 && connect()) {
        findPens();
    } else {
        mConnection.reset();
    }
}

PenInput::~PenInput() = default;

bool PenInput::connect() {
    mConnection.reset(xcb_connect(nullptr, nullptr));
    if (xcb_connection_has_error(mConnection.get()) != 0) {
        return false;
    }
    const xcb_query_extension_reply_t* const extension =
        xcb_get_extension_data(mConnection.get(), &xcb_input_id);
    if (extension == nullptr || extension->present == 0) {
        return false;
    }
    mExtension = extension->major_opcode;
    const Reply<xcb_input_xi_query_version_reply_t> version(xcb_input_xi_query_version_reply(
        mConnection.get(), xcb_input_xi_query_version(mConnection.get(), 2, 0), nullptr));
    if (!version || version->major_version < 2) {
        return false;
    }
    const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(mConnection.get())).data->root;
    select(mConnection.get(), root, XCB_INPUT_DEVICE_ALL, XCB_INPUT_XI_EVENT_MASK_HIERARCHY);
    return true;
}

/// Pens are heard themselves: the cursor that they move is GLFW's, and who asked the server for its
/// events here would take them away from GLFW.
void PenInput::findPens() {
    mPens.clear();
    const Reply<xcb_input_xi_query_device_reply_t> reply(xcb_input_xi_query_device_reply(
        mConnection.get(), xcb_input_xi_query_device(mConnection.get(), XCB_INPUT_DEVICE_ALL),
        nullptr));
    const xcb_atom_t pressure = atomOf(mConnection.get(), "Abs Pressure");
    if (!reply || pressure == XCB_ATOM_NONE) {
        return;
    }
    for (auto device = xcb_input_xi_query_device_infos_iterator(reply.get()); device.rem > 0;
         xcb_input_xi_device_info_next(&device)) {
        if (device.data->type != XCB_INPUT_DEVICE_TYPE_SLAVE_POINTER) {
            continue;
        }
        for (auto part = xcb_input_xi_device_info_classes_iterator(device.data); part.rem > 0;
             xcb_input_device_class_next(&part)) {
            if (part.data->type != XCB_INPUT_DEVICE_CLASS_TYPE_VALUATOR) {
                continue;
            }
            const auto* const axis = reinterpret_cast<const xcb_input_valuator_class_t*>(part.data);
            const double least = fromFixed(axis->min);
            const double most = fromFixed(axis->max);
            if (axis->label == pressure && most > least) {
                mPens[device.data->deviceid] = {axis->number, least, most,
                                                isNamedEraser(device.data)};
                select(mConnection.get(), mWindow, device.data->deviceid,
                       XCB_INPUT_XI_EVENT_MASK_MOTION);
            }
        }
    }
    xcb_flush(mConnection.get());
}

/// What a motion says of its device's pressure.
void PenInput::Pen::follow(const xcb_input_button_press_event_t* motion) {
    // Of all axes, those come that have changed, in the order of their bits.
    const std::uint32_t* const mask = xcb_input_button_press_valuator_mask(motion);
    const xcb_input_fp3232_t* value = xcb_input_button_press_axisvalues(motion);
    for (unsigned word = 0; word < motion->valuators_len; ++word) {
        for (std::uint32_t bits = mask[word]; bits != 0; bits &= bits - 1) {
            if (32 * word + static_cast<unsigned>(std::countr_zero(bits)) == axis) {
                const double part = (fromFixed(*value) - least) / (most - least);
                pressure = static_cast<float>(std::clamp(part, 0.0, 1.0));
            }
            ++value;
        }
    }
}

void PenInput::place(glm::dvec2 positionPx) {
    if (mUnplaced) {
        mTrack.add({positionPx, mUnplaced->pressure, mUnplaced->isEraser});
        mUnplaced.reset();
    }
}

/// A motion of a device names the place where the cursor was before it: where it came to is what
/// the next one names, and of the last one before an answer, what that answer says.
void PenInput::readEvents(unsigned answer, glm::dvec2 cursorThen) {
    bool haveDevicesChanged = false;
    bool isBefore = true;
    while (const Reply<xcb_generic_event_t> event{xcb_poll_for_event(mConnection.get())}) {
        if (isBefore && event->full_sequence >= answer) {
            isBefore = false;
            place(cursorThen);
        }
        // The extension's number stands where other events have theirs.
        const auto* const generic = reinterpret_cast<const xcb_ge_generic_event_t*>(event.get());
        if ((event->response_type & 0x7f) != XCB_GE_GENERIC || generic->extension != mExtension) {
            continue;
        }
        haveDevicesChanged |= generic->event_type == XCB_INPUT_HIERARCHY;
        const auto* const motion =
            reinterpret_cast<const xcb_input_button_press_event_t*>(event.get());
        if (generic->event_type != XCB_INPUT_MOTION || !mPens.contains(motion->deviceid)) {
            continue;
        }
        place({fromFixed(motion->event_x), fromFixed(motion->event_y)});
        Pen& pen = mPens[motion->deviceid];
        pen.follow(motion);
        mUnplaced = pen;
    }
    if (isBefore) {
        place(cursorThen);
    }
    if (haveDevicesChanged) {
        findPens();
    }
}

void PenInput::tell(std::span<InputEvent> events) {
    if (!mConnection || events.empty()) {
        return;
    }
    if (!hasPen()) { // the server is asked nothing; one that is plugged in is heard of
        readEvents(0, {});
        return;
    }
    // With the answer, all is here that GLFW has heard of.
    const xcb_query_pointer_cookie_t question = xcb_query_pointer(mConnection.get(), mWindow);
    const Reply<xcb_query_pointer_reply_t> answer(
        xcb_query_pointer_reply(mConnection.get(), question, nullptr));
    if (!answer) {
        return;
    }
    readEvents(question.sequence, {answer->win_x, answer->win_y});
    for (InputEvent& event : events) {
        mTrack.match(event);
    }
}

} // namespace celadon::ui
