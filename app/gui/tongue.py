"""The language of the window: our words, and Qt's own in its dialogs and menus."""

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QTranslator

from app.words import speak

_qt = QTranslator()


def speak_everywhere(code: str) -> None:
    """Say everything in this language from now on; Qt speaks English where it has no such language."""
    speak(code)
    QCoreApplication.removeTranslator(_qt)
    if _qt.load(f"qtbase_{code}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)):
        QCoreApplication.installTranslator(_qt)
