"""Figure 8: response of friction to an up-step and a down-step of the imposed velocity."""


def inputs(_config: dict) -> dict:
    """Friction over slip."""
    return {"response": "<results>/tables/velocity-step.tsv"}
