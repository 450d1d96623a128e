"""./reproduce behind the set-up: Snakemake with one line of progress; wrong options in one line.

With an option that changes what Snakemake says, its own output is left as it is.
"""

import argparse
import contextlib
import io
import logging
import re
import signal
import sys
from pathlib import Path
from typing import NoReturn

# the package scripts lies in the project's folder; the logger plugin lies beside this file
sys.path.insert(1, str(Path(__file__).parents[2]))

from snakemake import cli
from snakemake.exceptions import CliException, WorkflowError

from scripts.console.error_words import in_one_line, meant
from scripts.workflow import before_run

SAYS_OTHER_THINGS = re.compile(
    r"-[a-zA-Z]*[npqtDS]|--(dry-?run|quiet|verbose|debug|logger|print|list|lint|report|summary"
    r"|detailed-summary|dag|rulegraph|filegraph|d3dag|unlock|touch|cleanup|delete|archive|profile"
    r"|executor|version|help).*"
)
"""Options with which Snakemake's own output is wanted."""
CORES = re.compile(r"(?:--cores=?|-c=?)(.*)")


class OneLine(logging.Handler):
    """Errors of Snakemake before it has set up its own messages."""

    def emit(self, record: logging.LogRecord) -> None:
        """The reason alone."""
        print(in_one_line(record.getMessage()), file=sys.__stderr__)


def refuse(parser: argparse.ArgumentParser, reason: str) -> NoReturn:
    """Say what is wrong with the options, without the list of all of them."""
    reason = " ".join(reason.split())
    unknown = re.search(r"unrecognized arguments: (\S+)", reason)
    options = set(re.findall(r"--[a-z][a-z0-9-]+", parser.format_help()))
    print(f"error: {reason}{meant(unknown[1], options) if unknown else ''}", file=sys.__stderr__)
    sys.exit(2)


def wrong_cores(arguments: list[str]) -> str | None:
    """A number of cores with which Snakemake would wait without end."""
    for argument, following in zip(arguments, [*arguments[1:], ""], strict=True):
        if given := CORES.fullmatch(argument):
            number = given[1] or following
            if number != "all" and not re.fullmatch(r"0*[1-9]\d*", number):
                return number
    return None


def parse(arguments: list[str]) -> tuple[argparse.ArgumentParser, argparse.Namespace]:
    """The options, without the line of Snakemake that names profiles/default."""
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said):
            return cli.parse_args(arguments)
    except SystemExit:
        # words on a profile that is not there
        if lines := re.findall(r"^Error: .*", said.getvalue(), re.MULTILINE):
            raise SystemExit(in_one_line(lines[-1])) from None
        raise


def main(arguments: list[str]) -> None:
    """Check the arguments, then do as Snakemake's own command does."""
    number = wrong_cores(arguments)
    if number is not None:
        raise SystemExit(f"error: --cores is '{number}'; expected 1, 2, ..., or all")
    arguments = ["--list-target-rules" if each == "--list" else each for each in arguments]
    if not any(SAYS_OTHER_THINGS.fullmatch(argument) for argument in arguments):
        arguments = ["--logger", "progress", *arguments]
    argparse.ArgumentParser.error = refuse
    logging.getLogger("snakemake.logging").addHandler(OneLine())
    try:
        parser, options = parse(arguments)
        # Snakemake would first say that it has no place for its log
        before_run.refuse_unwritable(Path(options.directory or "."))
        done = cli.args_to_api(options, parser)
    except KeyboardInterrupt:
        # a second one, while Snakemake ends what the first one stopped
        sys.exit(128 + signal.SIGINT)
    except (ValueError, OSError, WorkflowError, CliException) as problem:
        raise SystemExit(in_one_line(str(problem))) from None
    sys.exit(0 if done else 1)


if __name__ == "__main__":
    main(sys.argv[1:])
