# SPDX-License-Identifier: GPL-3.0-or-later
"""The wire gesture: a click begins a chain, or keeps the active wire and goes on from its end."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import NOTHING, Message, Refused
from ..network.network import Network
from ..network.picks import FacePoint
from .candidates import CandidateWires, only_vertices
from .gesture import Gesture
from .picture import Intent

if TYPE_CHECKING:
    from ..network.network import Snap
    from ..solver.solver import LiveWire
    from .drawing import Drawing
    from .gesture import Committed


class WireGesture(Gesture):
    """The live wire from the chain's seed to the cursor.

    Parameters
    ----------
    drawing
        The state that gestures share.
    """

    def __init__(self, drawing: Drawing) -> None:
        self._drawing = drawing
        self.candidates = CandidateWires(drawing.engines, drawing.points, drawing.edges)
        self._message = NOTHING
        self.seen = False
        """Whether the active wire was shown before the click. The session tells, because waiting clicks show nothing."""
        self._kept = False
        self.seedless = False
        """Whether no live wire is shown, because the seed moves."""

    def take_warning(self) -> Message:
        """Return the warning about triangles that a kept wire leads around, once."""
        return self._drawing.engines.warning(self._drawing.options.along) if self._kept else NOTHING

    def aim(self, target: Snap | None) -> Message:
        """Find the wires to a target."""
        candidates, network = self.candidates, self._drawing.network
        self.seen = False
        if self.seedless:
            network = replace(network, seed=None)
        self._message = candidates.aim(target, network, self._drawing.options)
        return self._message

    @property
    def computing(self) -> bool:
        """Whether the wires may still change."""
        return self._drawing.progress < 1.0 or not self.candidates.final

    @property
    def waits(self) -> bool:
        """Whether a click has to wait.

        It keeps the candidate that was shown. If none was shown yet, it does not keep one merely because that finished first.
        """
        candidates = self.candidates
        return not (candidates.decided or (self.seen and candidates.active_final)) and self.computing

    def begun(self, target: Snap) -> Network:
        """Return the network with a new chain that begins at a target.

        Raises
        ------
        Refused
            If wires across the surface cannot begin there.
        """
        along = self._drawing.options.along
        if along == "SURFACE" and isinstance(target.pick, tuple):
            raise Refused(only_vertices(target.pick))
        network = replace(self._drawing.network, seed=None).joined(target, self._drawing.points)
        return replace(network, seed=network.seed_at(target, along))

    def commit(self) -> Committed:
        """Return the network with the active wire, or with a new chain if none is drawn."""
        candidates, network, options = self.candidates, self._drawing.network, self._drawing.options
        target = candidates.target
        self._kept = False
        if target is None:
            return None
        if network.seed is None:
            return self.begun(target)
        if self.waits:
            return self
        wire = candidates.active
        if wire is None:
            if network.seed.at(target.pick, options.along):
                raise Refused("ends-where-it-begins")
            raise Refused(self._message or Message.of("no-wire-reaches", pick=target.pick))
        ending = self.ending(target)
        known = {edge for own in network.wires for edge in own.edges()}
        # The snapped edges of a wire that is cut tell nothing about where it runs.
        if ending is Intent.CLOSE and known.issuperset(wire.edges()) and not isinstance(wire.end, FacePoint):
            raise Refused("way-back-along-chain")
        wire = replace(self._drawing.as_drawn(wire), alternatives=candidates.others if candidates.final else ())
        if not wire.leaves_trace:
            raise Refused("wire-too-short")
        network = network.joined(target, self._drawing.points).with_drawn(wire, target.pick, ending is not None)
        for joint in reversed(candidates.ring.joints if candidates.ring_active else ()):
            network = network.with_seed_in(wire, joint, self._drawing.points) or network
        self._kept = True
        return network

    def leaves_live(self, live: bool, target: Snap | None) -> bool:
        """Return whether the chain goes on, or a new one begins."""
        return not (live and target is not None and target.ends_chains)

    def ending(self, target: Snap) -> Intent | None:
        """Return how a wire to a target ends the chain, or None if the chain goes on."""
        if self._drawing.network.closes(target):
            return Intent.CLOSE
        return Intent.JOIN if target.ends_chains else None

    def cancel(self) -> None:
        """Show no wires. The pick under the cursor stays."""
        self.candidates.clear()

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute for it."""
        return [self._drawing.engines.get(self._drawing.options.along), *self.candidates.ring.lives]
