# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What a test's events press to hand over to its story, see story.py.

import story

story.proceed()
