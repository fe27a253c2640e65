# SPDX-License-Identifier: GPL-3.0-or-later
"""How the core tells that something cannot be done."""


class Refused(ValueError):  # noqa: N818 - the base of errors, which end in Error
    """Something cannot be done. It carries a sentence for the artist."""
