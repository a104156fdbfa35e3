// Commands about time: which animation plays, which moment is shown, playing.
#include "subedit/errors.h"
#include "ui/session.h"

namespace celadon::ui {

namespace {

constexpr double kMostSeconds = 1e6;

void requireWorld(const Session& session) {
    if (!session.hasWorld()) {
        throw UsageError("animation", "no model is open", "open one first");
    }
}

void chooseAnimation(Session& session, const Arguments& a) {
    requireWorld(session);
    const int count = static_cast<int>(session.mover().animations().size());
    const int number = a.integerWithin("number", -1, count - 1);
    MotionSetting next = session.motion.now;
    next.animation = number < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(number));
    session.changeMotion(std::move(next), "animation");
}

void goTo(Session& session, const Arguments& a) {
    requireWorld(session);
    MotionSetting next = session.motion.now;
    next.seconds = a.numberWithin("seconds", 0.0, kMostSeconds);
    session.setMotion(std::move(next));
}

void play(Session& session, const Arguments& a) {
    requireWorld(session);
    const bool isOn = a.flag("on");
    if (a.has("seconds")) {
        goTo(session, a);
    }
    session.motion.isPlaying = isOn;
}

void changePlayback(Session& session, const Arguments& a) {
    const double speed =
        a.has("speed") ? a.numberWithin("speed", 0.01, 100.0) : session.motion.speed;
    session.motion.loops = a.flag("loop", session.motion.loops);
    session.motion.speed = speed;
}

} // namespace

void addMotionCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("motion.animation", "Which of the model's animations plays; -1: none",
                 [&session](const Arguments& a) { chooseAnimation(session, a); });
    commands.add("motion.time", "The moment that is shown, seconds",
                 [&session](const Arguments& a) { goTo(session, a); });
    commands.add("motion.play", "Plays from a moment in seconds on, or stops at it",
                 [&session](const Arguments& a) { play(session, a); });
    commands.add("motion.playback", "How it plays: speed, 1 is that of the clock; loop",
                 [&session](const Arguments& a) { changePlayback(session, a); });
}

} // namespace celadon::ui
