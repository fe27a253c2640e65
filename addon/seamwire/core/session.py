# SPDX-License-Identifier: GPL-3.0-or-later
"""One drawing session: the live wire, what is kept, undo and redo.

Knows neither Blender nor the GPU. The tool in the viewport and the headless operator drive the same session; what it
shows and what it marks is decided here and nowhere else.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from .candidates import only_vertices
from .defaults import CLAMP_PERCENTILE, STRENGTHS
from .edge_loops import taken
from .guidance import Guidance
from .network import Network, Seed, Snap, Wire, name, undirected
from .seed_drag import SeedDrag
from .state import Intent, Queued

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .network import Pick

__all__ = ["CLAMP_PERCENTILE", "STRENGTHS", "Intent", "Session"]

_NOWHERE = "The wire cannot run on from here"


class Session(Guidance):
    """One drawing session on one mesh: what can be done with it. See `State` for what it is made with, and shows.

    Notes
    -----
    Methods that do something return whether it was done; where it was not, `message` says why, in words for the
    artist.
    """

    # What can be done

    def hover(self, snap: Snap | Pick | None, loop: bool = False) -> None:
        """Move the free end of the live wire.

        Parameters
        ----------
        snap
            What is under the cursor; None: nothing. A pick alone stands for one on the plain mesh.
        loop
            Show the loop through it instead, where it is an edge and wires run along edges.
        """
        if self._queue:
            return
        target = None if snap is None else Snap.of(snap)
        self._aim(target)
        asked = loop and self.along == "EDGES" and target is not None and isinstance(target.pick, tuple)
        self.revision += self._loops.aim(target.pick if asked else None)
        self._show_offers()

    def click(self, snap: Snap | Pick) -> bool:
        """Place a seed; where a wire is live, keep it and go on from there.

        On the chain's first seed this closes the chain; on another seed, a wire or a seam it joins there and ends the
        chain. While the way to the end or a loop is shown, that is kept. Before the wire is computed the click waits, see `poll`.
        """
        target = Snap.of(snap)
        if self._extension.wanted and not self._queue:
            return self.run_to_end()
        if self._loops.wire is not None and self._loops.edge == undirected(target.pick) and not self._queue:
            return self.loop(target)
        self.drag_cancel()
        if self._network.seed is None and not self._queue:
            return self.start(target)
        self._last_click = None
        if self._queue:
            self._queue.append(Queued("click", target))
            return True
        seen = self._candidates.active_final and target == self._candidates.target
        self._aim(target)
        # What is seen is kept; where nothing is seen yet, the one that is there first must not win for that.
        if not (self._candidates.decided or (seen and self._candidates.active_final)) and self._wires_computing:
            self._queue.append(Queued("click", target))
            self.revision += 1
            return True
        return self._keep(target)

    def start(self, snap: Snap | Pick) -> bool:
        """Begin a new chain, ending the one before."""
        target = Snap.of(snap)
        self._calm()
        if self.along == "SURFACE" and isinstance(target.pick, tuple):
            return self._refuse(only_vertices(target.pick))
        network = replace(self._network, seed=None).joined(target, self._points)
        if not self._change(replace(network, seed=network.seed_at(target, self.along))):
            return False
        self._last_click = (undirected(target.pick), self._history.steps)
        return True

    def loop(self, snap: Snap | Pick) -> bool:
        """Keep what is offered for an edge: the one that is shown, else the closed loop through it or, if none, the strip.

        A click on the same edge just before is taken back: a double click is a click first.
        """
        target = Snap.of(snap)
        edge = target.pick
        if self.along != "EDGES" or not isinstance(edge, tuple):
            return self._refuse("Loops are taken along edges: double-click on an edge")
        self.drag_cancel()
        shown = self._loops
        choice = shown.choice if shown.edge == undirected(edge) else 0
        self._take_back_click(edge)
        own = self._network.taken_through(edge)
        if own is not None and own.marks == self.marking:
            # Of a double click, the first press took it already.
            return not choice or self._next_kept(own, choice)
        offers = self._find_offers(edge)
        if not offers:
            if self.computing:
                self._queue.append(Queued("loop", target))
                self.revision += 1
                return True
            return self._refuse(self.message or f"No edges run on from {name(edge)}")
        wire = replace(taken(offers, min(choice, len(offers) - 1), self.marking), mirror=self._network.mirror)
        return self._change(replace(self._network, wires=(*self.wires, wire)))

    def _take_back_click(self, edge: Pick) -> None:
        last = self._queue[-1] if self._queue else None
        if last is not None and last.kind == "click" and undirected(last.snap.pick) == undirected(edge):
            self._queue.pop()
        elif self._last_click == (undirected(edge), self._history.steps):
            self._restore(self._history.forget_step(self._network))
        self._last_click = None

    def end_chain(self) -> None:
        """Let go of the live wire, or of a dragged seed; the kept wires stay."""
        self._calm()
        if self._network.seed is None:
            return
        # No step of its own for undo: taking back the last wire after this brings the chain back to life.
        self._set(replace(self._network, seed=None))
        self._candidates.chosen = None
        self._aim(self._candidates.target, again=True)

    def close(self) -> bool:
        """Lead the live wire back to the chain's first seed, keep it and end the chain."""
        first = self.closing_point
        if first is None:
            return self._refuse("There is no chain to close: draw a wire first")
        self._extension.wanted = False
        return self.click(Snap(first, "SEED"))

    def toggle(self) -> bool:
        """Make the other of the two wires the active one, until it is kept; of what is offered for an edge, the next."""
        part = self._loops if self._loops.wanted else self._candidates
        why = part.swap()
        if why:
            return self._refuse(why)
        self.message = ""
        if part is self._candidates:
            self._show_extension()
        self.revision += 1
        return True

    def toggle_kept(self, wire: Wire) -> bool:
        """Let a kept wire take its other way, that of the other metric; one from a click on an edge, what is next there."""
        self._calm()
        own = self._network.find(wire)
        if own is None:
            return self._refuse("This wire is not there any more")
        if own.through is not None:
            return self._next_kept(own)
        if own.closed:
            return self._refuse("A loop has no other way")
        if own.alternative is not None:
            return self._take_other_way(own, own.alternative)
        try:
            self._retraces.add(self._network, own)
        except ValueError as error:
            return self._refuse(str(error))
        self._read_progress()
        self._poll_retraces()
        return not self.message

    def drop(self, wire: Wire) -> bool:
        """Remove a kept wire."""
        self._calm()
        own = self._network.find(wire)
        if own is None:
            return self._refuse("This wire is not there any more")
        return self._change(self._network.without(own))

    def insert(self, wire: Wire, pick: Pick) -> bool:
        """Put a seed into a kept wire, which makes two wires of it; a loop is cut opposite to the seed as well."""
        self._calm()
        network = self._network.with_seed_in(wire, pick, self._points)
        if network is None:
            return self._refuse(f"No seed can be put into the wire at {name(pick)}")
        return self._change(network)

    def drag(self, snap: Snap | Pick) -> bool:
        """Take hold of a seed of the network; `drag_to` moves it, and its wires with it.

        On a wire (``Snap.to == "WIRE"``) a seed is put there first, in one step for undo with the move.
        """
        target = Snap.of(snap)
        self._calm()
        network = self._network.joined(target, self._points)
        try:
            self._drag = SeedDrag(self._engines, network, target.pick, self._points)
        except ValueError as error:
            return self._refuse(str(error))
        self._read_progress()
        self._candidates.clear()
        self._loops.clear()
        self._extension.clear()
        self.message = ""
        self.revision += 1
        return True

    def drag_to(self, snap: Snap | Pick | None) -> bool:
        """Move the dragged seed; its wires follow as soon as they are computed. None: over nothing, it stays."""
        drag = self._drag
        if drag is None:
            return self._refuse("No seed is being moved")
        if snap is None or drag.ending:
            return False
        before = (drag.target, drag.network, self.message)
        self._candidates.target = Snap.of(snap)
        moved = drag.to(Snap.of(snap))
        self._read_progress()
        self.message = drag.message
        self.revision += before != (drag.target, drag.network, self.message)
        return moved

    def drag_end(self) -> bool:
        """Leave the dragged seed where it is, as soon as its wires are computed; one step for undo."""
        drag = self._drag
        if drag is None:
            return self._refuse("No seed is being moved")
        if not drag.final:
            drag.ending = True
            return True
        self._drag = None
        self.revision += 1
        if drag.message or drag.target is None:
            why = drag.message
            self._aim(self._candidates.target, again=True)
            return self._refuse(why) if why else True
        return self._change(drag.network.joined(drag.target, self._points))

    def run_to_end(self, preview: bool = False) -> bool:
        """Let the live wire run straight on until it meets a seam, a wire, the boundary, the mirror or itself.

        Parameters
        ----------
        preview
            Show it, for wherever the cursor goes; a click, or this without `preview`, keeps it. `stop_preview` ends that.
        """
        if self._network.seed is None:
            return self._refuse("Nothing runs on: place a seed first")
        if self.along == "SURFACE":
            return self._refuse("Wires run on along edges, not across the surface")
        self.drag_cancel()
        if preview:
            self._extension.wanted = True
            self._show_extension()
            return self._extension.wire is not None or self.computing or self._refuse(self.message or _NOWHERE)
        target = self._candidates.target
        if self._queue or (target is not None and not self._candidates.active_final and self._wires_computing):
            if target is None:
                return self._refuse(_NOWHERE)
            self._extension.wanted = False
            self._queue.append(Queued("run", target))
            self.revision += 1
            return True
        wire = self._find_extension()
        if wire is None:
            return self._refuse(self.message or _NOWHERE)
        self._extension.wanted = False
        return self._change(replace(self._network, wires=(*self.wires, wire), seed=None))

    def adopt(self, network: Network, seams: ArrayLike) -> None:
        """Go on with what the mesh has now; what was done before is not for `undo` any more.

        Parameters
        ----------
        network
            Its wires and strokes. The mirror stays what it is; the live wire begins at the network's seed.
        seams
            (k, 2) the edges that are seams and no wires.
        """
        self._calm()
        self._stops.set_seams(seams)
        self._retraces.clear()
        self._history.forget()
        # Wires of the first version do not know their images: they are what is a seam of them still.
        network = self._images.complete(network, seams)
        seed = network.seed
        if seed is not None and seed != self._network.seed and not self._sow(seed):
            seed = None
        self._set(replace(network, seed=seed, mirror=self._network.mirror))
        self._settle()

    def undo(self) -> bool:
        """Take back the last step: a wire, a loop, a seed, a move, whatever was done; first what still waits."""
        if self._queue:
            self._queue.pop()
            self.revision += 1
            return True
        if self.drag_cancel():
            return True
        if self._retraces.drop_last():
            self.revision += 1
            return True
        network = self._history.back(self._network)
        if network is None:
            return self._refuse("Nothing to undo in this drawing")
        self._restore(network)
        return True

    def redo(self) -> bool:
        """Bring back what undo took."""
        self.drag_cancel()
        network = self._history.forth(self._network)
        if network is None:
            return self._refuse("Nothing to redo in this drawing")
        self._restore(network)
        return True

    def poll(self) -> bool:
        """Take in what the library has computed since, and do the clicks that waited for it.

        Returns
        -------
        bool
            Whether there is something new to be seen.
        """
        drag = self._drag
        still = self._candidates.final and self._loops.final and (drag is None or drag.final)
        if still and not self.computing and not self._queue and not self._retraces:
            return False
        before = (self.revision, round(self._progress, 2))
        self._read_progress()
        self._poll_retraces()
        if drag is not None and not drag.final:
            self.revision += drag.poll()
            self.message = drag.message
            if drag.final and drag.ending:
                self.drag_end()
        while self._queue and self._poll_queue():
            pass
        if not self._queue and not self._candidates.final:
            self._aim(self._candidates.target, again=True)
        self._show_offers()
        self._show_extension()
        return before != (self.revision, round(self._progress, 2))

    def wait(self) -> None:
        """Wait until everything is computed and every waiting click is done."""
        while True:
            for live in self._working():
                try:
                    live.wait()
                except ValueError as error:  # what it is to compute cannot be computed
                    self._refuse(str(error))
            self.poll()
            if not self._queue and not self._retraces and not self.computing:
                return

    # How it is done

    def _keep(self, target: Snap) -> bool:
        live = self._candidates
        wire = live.active
        seed = self._network.seed
        if wire is None:
            if seed is not None and seed.at(target.pick, self.along):
                return self._refuse("The wire ends where it begins: click somewhere else")
            return self._refuse(self.message or f"No wire reaches {name(target.pick)}")
        ending = self._ending(target)
        if ending is Intent.CLOSE and {edge for own in self.wires for edge in own.edges()}.issuperset(wire.edges()):
            return self._refuse("The way back runs along the chain itself: place another seed first")
        wire = replace(
            wire,
            marks=self.marking,
            mirror=self._network.mirror,
            strength=self.strength,
            alternative=live.other if live.final else None,
        )
        network = self._network.joined(target, self._points)
        after = None
        if ending is None:
            first = None if seed is None else seed.began
            after = Seed(target.pick, first=first)
            if self.along == "EDGES":
                after = Seed(wire.last_edge, forward=True, clicked=target.pick, first=first)
        if not self._change(replace(network, wires=(*network.wires, wire), seed=after)):
            return False
        self._last_click = (undirected(target.pick), self._history.steps)
        return True

    def _poll_queue(self) -> bool:
        """Do the oldest waiting click if its wire is there; returns whether it was done."""
        head = self._queue[0]
        self._aim(head.snap, again=True)
        if head.kind in {"loop", "offer"}:
            waits = not self._find_offers(head.snap.pick) and self.computing
        else:
            waits = not self._candidates.decided and self._wires_computing
        if waits:
            return False
        del self._queue[0]
        rest, self._queue = self._queue, []
        if head.kind == "run":
            self.run_to_end()
        elif head.kind == "loop":
            self.loop(head.snap)
        elif head.kind == "offer" and head.snap.wire is not None:
            self.toggle_kept(head.snap.wire)
        else:
            self.click(head.snap)
        self._queue += rest
        return True
