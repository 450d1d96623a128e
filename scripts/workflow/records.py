"""What each file was made of: Snakemake's records, kept with the files and not in .snakemake.

The record of results/tables/a.tsv is results/records/tables/a.tsv.json: parameters, inputs and
their checksums. It goes where the results go.
"""

from functools import lru_cache, partial
from pathlib import Path

from snakemake.persistence import RECORD_FORMAT_VERSION, MetadataRecord
from snakemake.persistence.file import FilePersistence

FOLDER = "records"
BUILD = "build"


class Records(FilePersistence):
    """Records of what is made in a folder of results, and of what is built."""

    def __init__(self, results: str, **settings) -> None:
        self.folders = (results, BUILD)
        super().__init__(**settings)

    def _record_path(self, subject: str, key: str) -> str:
        for folder in self.folders if subject == self._metadata_path else ():
            if key.startswith(f"{folder}/"):
                return f"{folder}/{FOLDER}/{key.removeprefix(f'{folder}/')}.json"
        return super()._record_path(subject, key)

    def _read_record(self, key: str) -> MetadataRecord | None:
        """A file without a record may be made of anything: it is stale."""
        record = super()._read_record(key)
        if record or not Path(key).exists():
            return record
        return MetadataRecord(record_format_version=RECORD_FORMAT_VERSION, params=["no record"])

    def has_metadata(self, job) -> bool:
        """What a job has made is compared, even if a part of it is missing."""
        return not job.output or any(self.metadata(path) for path in job.output)

    def _mark_incomplete(self, key: str, external_jobid: str | None) -> None:
        """A job that is killed leaves no record of what it was to replace."""
        self._delete_record(key)
        super()._mark_incomplete(key, external_jobid)

    @lru_cache  # noqa: B019
    def _params(self, job) -> list[str]:
        """With the command, which Snakemake compares only together with times of scripts."""
        return sorted([*super()._params(job), str(job.rule.shellcmd)])


def keep_with(results: str) -> None:
    """From now on Snakemake keeps its records with the results in this folder."""
    import snakemake.workflow  # which no program but Snakemake can import

    snakemake.workflow.FilePersistence = partial(Records, results)
