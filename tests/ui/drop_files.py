#!/usr/bin/python3
"""Drags files from a window of its own onto another one and drops them (XDND 5):
    drop_files.py WINDOW X Y FILE...
WINDOW is the number of an X window, X and Y a place on the screen. Exit code 1: it did not take them."""
import sys
import time
from pathlib import Path

from Xlib import X, display
from Xlib.protocol import event


class Source:
    def __init__(self, target, files):
        self.display = display.Display()
        self.window = self.display.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
        self.target = self.display.create_resource_object("window", target)
        self.list = "".join(Path(f).absolute().as_uri() + "\r\n" for f in files).encode()
        self.window.set_selection_owner(self.atom("XdndSelection"), X.CurrentTime)

    def atom(self, name):
        return self.display.intern_atom(name)

    def tell(self, kind, *numbers):
        data = [self.window.id, *numbers] + [0] * (4 - len(numbers))
        message = event.ClientMessage(window=self.target, client_type=self.atom(kind), data=(32, data))
        self.target.send_event(message)
        self.display.flush()

    def await_answer(self, kind):
        """Gives out the list to who asks, until an answer comes. @return its data"""
        end = time.monotonic() + 30
        while time.monotonic() < end:
            if not self.display.pending_events():
                time.sleep(0.01)
                continue
            e = self.display.next_event()
            if e.type == X.SelectionRequest:
                e.requestor.change_property(e.property, e.target, 8, self.list)
                e.requestor.send_event(
                    event.SelectionNotify(
                        time=e.time, requestor=e.requestor, selection=e.selection, target=e.target, property=e.property
                    )
                )
            elif e.type == X.ClientMessage and e.client_type == self.atom(kind):
                return e.data[1]
        sys.exit(f"no {kind}")

    def drop(self, x, y):
        self.tell("XdndEnter", 5 << 24, self.atom("text/uri-list"))
        self.tell("XdndPosition", 0, x << 16 | y, X.CurrentTime, self.atom("XdndActionCopy"))
        if self.await_answer("XdndStatus")[1] & 1 == 0:
            sys.exit("the window takes no files")
        self.tell("XdndDrop", 0, X.CurrentTime)
        if self.await_answer("XdndFinished")[1] == 0:  # GLFW 3.3 says how many bytes it took
            sys.exit("the window did not take the files")


def main():
    window, x, y, *files = sys.argv[1:]
    Source(int(window), files).drop(int(x), int(y))


if __name__ == "__main__":
    main()
