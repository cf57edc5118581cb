from grasptypes.versions.doctor import edited_files

STATUS = {
    "grasps": [{"changed outs": {"data/grasps": "modified", "data/grasps.csv": "modified"}}],
    "renders": [
        {"changed deps": {"src": "modified"}},
        {"changed outs": {"data/renders": "modified"}},
    ],
    "reports": ["changed command", {"changed outs": {"reports/table1.csv": "modified"}}],
    "models": [{"changed outs": {"models": "deleted"}}],
}
DATA_STATUS = {"uncommitted": {"modified": ["data/grasps/mug/use.parquet", "data/renders/mug.zip"]}}


def test_only_results_that_changed_alone_count_and_folders_are_opened() -> None:
    assert edited_files(STATUS, DATA_STATUS) == ["data/grasps.csv", "data/grasps/mug/use.parquet"]


def test_a_clean_repository_has_none() -> None:
    assert edited_files({}, {}) == []
