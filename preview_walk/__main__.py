"""`python -m preview_walk` is `preview-walk`."""

from preview_walk.cli.main import main

raise SystemExit(main())
