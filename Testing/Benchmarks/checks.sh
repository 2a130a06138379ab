#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What run.sh here and in peers/ refuse alike. To be read by them: source checks.sh

refuse_option() # the option
{
  echo "The option $1 is unknown (nothing would come of it). The head of $0 has those there are." >&2
  exit 1
}

need_to_draw() # the Python
{
  if ! "$1" -c "import matplotlib, numpy" 2> /dev/null; then
    echo "$1 has no matplotlib or no numpy (they draw plots and pictures). Install them; on" \
      "Debian: bash Testing/install-packages.sh" >&2
    exit 1
  fi
}
