#include "ui/background_open.h"

#include "subedit/errors.h"
#include "ui/window.h"

namespace celadon::ui {

void BackgroundOpen::start(const OpenRequest& request) {
    if (mFuture.valid()) {
        mNext = request;
        mIsWanted = false;
        return;
    }
    mRequest = request;
    mIsWanted = true;
    mStart = std::chrono::steady_clock::now();
    mFuture = std::async(std::launch::async, [request, services = mSession.services()] {
        struct Wake {
            ~Wake() { Window::wake(); }
        } const wake;
        return prepareScene(services.readWorld(request), services.isPaintable);
    });
}

double BackgroundOpen::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - mStart).count();
}

bool BackgroundOpen::poll() {
    if (!mFuture.valid() ||
        mFuture.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return false;
    }
    try {
        OpenedScene scene = mFuture.get();
        if (mIsWanted) {
            mSession.adopt(mRequest, std::move(scene));
            Command opened{"file.open",
                           {{"model", mRequest.model}, {"material", mRequest.material}}};
            if (mRequest.diameterMm) {
                opened.arguments["diameter"] = *mRequest.diameterMm;
            }
            mSession.dispatcher().announce(opened);
        }
    } catch (const std::exception& error) {
        if (mIsWanted) {
            mSession.notify(Notice::Kind::Error, error.what());
        }
    }
    mIsWanted = false;
    if (mNext) {
        start(*std::exchange(mNext, std::nullopt));
    }
    return true;
}

} // namespace celadon::ui
